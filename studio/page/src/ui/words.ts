// Numbers and keys in words.

/** A number with as many decimals as it needs, three at the most. */
export function short(value: number | null | undefined, places = 3): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  return String(Number(value.toFixed(places)));
}

/** A key as a label: without its unit, with spaces. */
export function label(key: string): string {
  const name = key.split(".").at(-1) ?? key;
  const plain = name.replace(/_(mm|deg|g)$/, "").replaceAll("_", " ");
  return plain.charAt(0).toUpperCase() + plain.slice(1);
}

/** What the library calls by an option of the command line, and where the page has it. */
const OF_COMMAND_LINE: [RegExp, string][] = [
  [/--hold-out-heights/g, "Heights held out"],
  [/--height (\S+)/g, "A height of $1 m"],
  [/\(--strength\)/g, "(Checks, strength)"],
  [/\(drop --model frame\)/g, "(Drop, the frame's own mechanics)"],
];

/** A sentence of the library in the words of the page. */
export function inPageWords(sentence: string): string {
  return OF_COMMAND_LINE.reduce((text, [option, words]) => text.replace(option, words), sentence);
}

/** A size in words. */
export function size(mm: readonly number[] | undefined): string {
  return mm ? `${mm.map((side) => short(side, 1)).join(" × ")} mm` : "";
}

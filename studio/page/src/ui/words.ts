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

/** A size in words. */
export function size(mm: readonly number[] | undefined): string {
  return mm ? `${mm.map((side) => short(side, 1)).join(" × ")} mm` : "";
}

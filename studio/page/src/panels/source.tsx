// Story 1: the frame file as text, editable; refusals stand at their lines.
import { useLayoutEffect, useRef, useState } from "preact/hooks";
import { baseName } from "../state/doc.ts";
import { showLine } from "../state/focus.ts";
import { presetNamed } from "../state/opening.ts";
import { doc, latest, refused, replaced, take } from "../state/studio.ts";

/** The text is read when nothing was typed for this long, ms. */
const REST_MS = 350;

export function Source() {
  const [typed, setTyped] = useState<string | null>(null);
  const timer = useRef<ReturnType<typeof setTimeout> | undefined>(undefined);
  const text = typed ?? doc.value.text;
  // What was typed stays until the page has all of it: what comes back of it earlier is older. At once: an effect after the first picture would
  // take back what was typed meanwhile.
  useLayoutEffect(() => setTyped((now) => (now === doc.value.text ? null : now)), [doc.value.text]);
  // What is set elsewhere takes its place.
  useLayoutEffect(() => {
    clearTimeout(timer.current);
    setTyped(null);
  }, [replaced.value]);
  const refusal = refused.value?.refusal;
  const line = refusal?.place?.file === `${doc.value.name}.toml` ? refusal.place.line : null;
  const type = (next: string) => {
    setTyped(next);
    clearTimeout(timer.current);
    timer.current = setTimeout(() => read(next), REST_MS);
  };
  // Whoever leaves the text means what stands there.
  const leave = () => {
    clearTimeout(timer.current);
    if (typed !== null && typed !== doc.value.text) read(typed);
  };
  const read = (next: string) => {
    const { preset, name } = latest();
    const edited = {
      text: next,
      preset: presetNamed(baseName(next)) ?? preset,
      name: name === preset ? `my-${preset}` : name,
    };
    take(edited, { group: "text" });
  };
  return (
    <div class="source">
      <label for="toml">
        <code>{doc.value.name}.toml</code>: what is not stated is that of the base
      </label>
      <div class="editor">
        <pre class="lines" aria-hidden="true">
          {text.split("\n").map((_, at) => (
            <span key={at} class={at + 1 === line ? "wrong" : ""}>{`${at + 1}\n`}</span>
          ))}
        </pre>
        <textarea
          id="toml"
          spellcheck={false}
          autocomplete="off"
          wrap="off"
          rows={Math.max(12, text.split("\n").length + 1)}
          value={text}
          aria-invalid={refusal !== undefined}
          aria-describedby="toml-refusal"
          onInput={(event) => type(event.currentTarget.value)}
          onBlur={leave}
        />
      </div>
      <div id="toml-refusal" role="status">
        {refusal && (
          <p class="fault">
            {line !== null && (
              <button type="button" class="link" onClick={() => showLine(line)}>
                line {line}
              </button>
            )}{" "}
            {refusal.message}
            {refusal.remedy && <span class="remedy">{refusal.remedy}</span>}
          </p>
        )}
      </div>
    </div>
  );
}

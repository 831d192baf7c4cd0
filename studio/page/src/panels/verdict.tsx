// What a diagnosis says: the verdict, the gaps before and after, the effects with their parameters, and what to measure next.
import type { EngineFile } from "../engine/messages.ts";
import type { Diagnosed, Estimate } from "../engine/outcomes.ts";
import { save } from "../state/downloads.ts";
import { short } from "../ui/words.ts";

const VERDICTS: Record<Diagnosed["verdict"], string> = {
  named: "The model lacks",
  ambiguous: "Several explanations fit",
  none_suffices: "No known effect explains the drops",
  nothing_missing: "Nothing is missing: the model explains the drops",
};

export function Verdict({ found, files, of }: { found: Diagnosed; files: EngineFile[]; of: string }) {
  const { gap, where } = found;
  const { body, after: refitted } = found.base;
  const heights = found.held_out_heights_m.map((height_m) => `${short(height_m)} m`).join(", ");
  const unseen = heights ? `${heights}, which no fit saw` : "each height, predicted from the others";
  const largest = [...where.cells].sort((a, b) => size(b) / b.error_g - size(a) / a.error_g).slice(0, 5);
  return (
    <div class="verdict" data-verdict={found.verdict}>
      <h3>
        {VERDICTS[found.verdict]}{" "}
        {found.verdict === "named" && found.effects.map(({ id }) => id.replaceAll("_", " ")).join(" and ")}
      </h3>
      <p class="about">
        {of}. Mass {short(1000 * body.mass_kg, 1)} g and gap {short(body.gap_mm, 1)} mm of the {body.from}.
      </p>
      {found.reasons.map((reason) => (
        <p key={reason}>{reason}</p>
      ))}
      <Gaps title={`Gap between mean wave and model, ${gap.unit}`} {...gap} />
      <Gaps
        title={`The same at ${unseen}`}
        before={gap.held_out_before}
        after={gap.held_out_after}
        floor={gap.held_out_floor}
      />
      {Object.keys(refitted).length > 0 && <p>Refitted: {inWords(refitted)}</p>}
      {found.effects.map(({ id, parameters }) => (
        <p key={id}>
          {id.replaceAll("_", " ")}: {inWords(parameters)}
        </p>
      ))}
      <table>
        <caption>Ranking: what each leaves of the other heights</caption>
        <thead>
          <tr>
            <th scope="col">effects</th>
            <th scope="col">left, g</th>
            <th scope="col">why not</th>
          </tr>
        </thead>
        <tbody>
          {found.ranking.slice(0, 8).map(({ id, left_out_g, reason_rejected }) => (
            <tr key={id}>
              <th scope="row">{id.replaceAll("_", " ")}</th>
              <td>{short(left_out_g, 2)}</td>
              <td>{reason_rejected}</td>
            </tr>
          ))}
        </tbody>
      </table>
      <table>
        <caption>Where model and drops differ most</caption>
        <tbody>
          {largest.map((cell) => (
            <tr key={`${cell.height_m} ${cell.phase}`}>
              <th scope="row">
                {short(cell.height_m)} m, {cell.phase.replaceAll("_", " ")}
              </th>
              <td>{short(size(cell), 1)} g</td>
              <td>± {short(cell.error_g, 1)} g</td>
            </tr>
          ))}
        </tbody>
      </table>
      {found.next_experiment && (
        <p>
          <b>Next:</b> {found.next_experiment.what}; it tells {found.next_experiment.between.join(" from ")}.
        </p>
      )}
      <div class="row">
        {files.map(({ path, bytes }) => (
          <button key={path} type="button" onClick={() => save(path, bytes)}>
            Download {path}
          </button>
        ))}
      </div>
    </div>
  );
}

function size({ apart_g, residual_g }: { apart_g?: number; residual_g?: number }): number {
  return apart_g ?? residual_g ?? 0;
}

/** Parameters with their 95 % intervals. One without a unit is a number. */
function inWords(parameters: Record<string, Estimate>): string {
  const one = ([key, { value, unit, ci95 }]: [string, Estimate]) => {
    const of = [key, "=", value.toPrecision(4), unit === "1" ? "" : unit].filter(Boolean).join(" ");
    return `${of} (${ci95.map((end) => end.toPrecision(4)).join(" to ")})`;
  };
  return Object.entries(parameters).map(one).join(", ");
}

type Rows = { title: string; before: number; after: number; floor: number };

function Gaps({ title, before, after, floor }: Rows) {
  const full = Math.max(before, after, floor) || 1;
  const rows = [
    ["before", before, "bad"],
    ["after", after, "good"],
    ["floor: what the drops can show", floor, "track"],
  ] as const;
  return (
    <table>
      <caption>{title}</caption>
      <tbody>
        {rows.map(([words, value, kind]) => (
          <tr key={words}>
            <th scope="row">{words}</th>
            <td>{short(value, 2)}</td>
            <td>
              <svg class="bar" viewBox="0 0 100 8" preserveAspectRatio="none" aria-hidden="true">
                <rect class={kind} width={(100 * value) / full} height="8" />
              </svg>
            </td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

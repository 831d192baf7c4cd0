// The records of the drops that are open: how many of each height, what is flagged, and what can be left out.
import type { Measured } from "../engine/outcomes.ts";
import { inPageWords, short } from "../ui/words.ts";

/** As many names are told one by one. */
const FEW = 6;

/** Files in words: their names, or how many there are in which folders. */
function inShort(names: string[]): string {
  if (names.length <= FEW) return names.join(", ");
  const folders = [...new Set(names.map((name) => name.split("/").slice(0, -1).join("/")))].filter(Boolean).sort();
  const more = folders.length > FEW ? ` and ${folders.length - FEW} more` : "";
  const where = folders.length > 0 ? ` in ${folders.slice(0, FEW).join(", ")}${more}` : "";
  return `${names.length} files${where}`;
}

/** Files whose drops are all of one height of one frame: they can be left out with it. */
function filesOf(measured: Measured, frame: string | null, height_m: number): string[] {
  const isOf = (drop: Measured["drops"][number]) => drop.frame === frame && drop.height_m === height_m;
  const others = new Set(measured.drops.filter((drop) => !isOf(drop)).map(({ source }) => source));
  return [...new Set(measured.drops.filter(isOf).map(({ source }) => source))].filter((file) => !others.has(file));
}

type Props = { measured: Measured; names: string[]; onLeaveOut: (files: string[]) => void };

export function Records({ measured, names, onLeaveOut }: Props) {
  const flagged = measured.drops.filter(({ flags }) => flags.length > 0);
  return (
    <>
      <p class="about">{inShort(names)}</p>
      <table>
        <caption>Records</caption>
        <thead>
          <tr>
            <th scope="col">height</th>
            <th scope="col">drops</th>
            <th scope="col">clean</th>
            <th scope="col">median peak</th>
            <th scope="col">
              <span class="hidden">leave out</span>
            </th>
          </tr>
        </thead>
        <tbody>
          {measured.heights.map((of) => (
            <tr key={`${of.frame} ${of.height_m}`}>
              <th scope="row">
                {of.frame} {short(of.height_m)} m
              </th>
              <td>{of.drops}</td>
              <td>{of.clean}</td>
              <td>{of.clean_peak_axial_g ? `${short(of.clean_peak_axial_g.median, 1)} g` : "–"}</td>
              <td>{measured.heights.length > 1 && <LeaveOut {...of} measured={measured} onLeaveOut={onLeaveOut} />}</td>
            </tr>
          ))}
        </tbody>
      </table>
      {flagged.length > 0 && (
        <details>
          <summary>{flagged.length} records are flagged</summary>
          <ul>
            {flagged.map(({ trial, height_m, flags }) => (
              <li key={`${trial} ${height_m}`}>
                {trial}, {short(height_m)} m: {flags.map(({ reason }) => reason).join("; ")}
              </li>
            ))}
          </ul>
        </details>
      )}
      {measured.notes.map((note) => (
        <p key={note} class="caution">
          {inPageWords(note)}
        </p>
      ))}
    </>
  );
}

type Left = { measured: Measured; frame: string | null; height_m: number; onLeaveOut: Props["onLeaveOut"] };

/** Of a table with several heights nothing is left out. */
function LeaveOut({ measured, frame, height_m, onLeaveOut }: Left) {
  const files = filesOf(measured, frame, height_m);
  if (files.length === 0) return null;
  return (
    <button
      type="button"
      class="link"
      aria-label={`Leave out ${frame ?? ""} ${short(height_m)} m`}
      onClick={() => onLeaveOut(files)}
    >
      Leave out
    </button>
  );
}

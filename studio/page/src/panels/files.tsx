// Story 7: what is taken away, with the bytes of the command line, and a link.
import { computed, signal } from "@preact/signals";
import type { Setting } from "../state/link.ts";
import { LONGEST_LINK, toFragment } from "../state/link.ts";
import type { Doc } from "../state/doc.ts";
import { hasComment, isUnchanged } from "../state/doc.ts";
import { complain, quiet, tell } from "../state/notice.ts";
import { openFrame } from "../state/opening.ts";
import { changedKeys, doc, frame, pending, refused, shownDoc, valueOf, violations } from "../state/studio.ts";
import { right } from "../state/focus.ts";
import { asChanged, download, made, save, saveText } from "../state/downloads.ts";
import { Work } from "../state/work.ts";
import { Progress } from "../ui/progress.tsx";

const KINDS: { which: string; words: string }[] = [
  { which: "stl", words: "STL, every part (ZIP)" },
  { which: "plates", words: "3MF plates for the printer (ZIP)" },
  { which: "glb", words: "GLB, the assembled frame" },
  { which: "step", words: "STEP, every part and the frame (ZIP)" },
  { which: "bill", words: "Bill of materials (CSV)" },
  { which: "instructions", words: "Assembly instructions (PDF)" },
  { which: "fold", words: "Assembly steps (JSON)" },
  { which: "report", words: "Report with pictures, how to print (Markdown, ZIP)" },
  { which: "folder", words: "Folder of flexframe build: parts, plates, report, pictures (ZIP)" },
];

const work = new Work<string>();
/** Every printed part is a file. */
const parts = computed(() =>
  (frame.value?.masses.lines ?? [])
    .filter(({ kind }) => kind === "printed")
    .map(({ name }) => name)
    .sort(),
);
/** The link that was made last, and of what: it is not that of a frame that was changed since. */
const link = signal<{ of: Doc; url: string } | null>(null);
/** Files are made of a good frame only; a frame of before would not belong to the frame file. */
const held = computed(() => refused.value !== null || frame.value === null);

/** The frame as the command line is given it. */
const given = computed(() => (isUnchanged(doc.value) ? doc.value.preset : `${doc.value.name}.toml`));

export function Files() {
  const get = (which: string) => void work.run(() => download([which]).then(() => which));
  return (
    <div class="files">
      {refused.value ? (
        <p class="caution" role="status">
          {doc.value.name}.toml is refused, so no files are made of it. The frame file and the link hold it as it was
          typed. The reason: {refused.value.refusal.message}
        </p>
      ) : (
        <p class="about">
          The files have the bytes that <code>flexframe build {given.value} --step</code> writes, the assembly's those
          of <code>flexframe fold {given.value}</code>.
        </p>
      )}
      {violations.value > 0 && !refused.value && (
        <p class="caution" role="status">
          {violations.value === 1 ? "One limit is" : `${violations.value} limits are`} violated. The files are made all
          the same.{" "}
          <button type="button" class="link" onClick={() => (right.value = "checks")}>
            Show {violations.value === 1 ? "it" : "them"}
          </button>
        </p>
      )}
      <div class="stack">
        <button type="button" onClick={() => void saveText()}>
          Frame file ({doc.value.name}.toml)
        </button>
        {KINDS.map(({ which, words }) => (
          <button key={which} type="button" disabled={held.value || work.running.value} onClick={() => get(which)}>
            {words}
          </button>
        ))}
      </div>
      <Progress of={work} words="Making the files" />
      <details>
        <summary>One part as STL</summary>
        <ul>
          {parts.value.map((part) => (
            <li key={part}>
              <button
                type="button"
                class="link"
                disabled={held.value || work.running.value}
                onClick={() => void work.run(async () => (await one(part), part))}
              >
                {part}.stl
              </button>
            </li>
          ))}
        </ul>
      </details>
      <h3>A link to this frame</h3>
      <p class="about">
        It holds {refused.value ? "the frame file as it was typed" : "the differences from the preset"}, behind the #,
        which no server sees.
      </p>
      <div class="row">
        <button type="button" onClick={() => void share()}>
          Copy the link
        </button>
      </div>
      {link.value?.of === doc.value && (
        <input
          type="text"
          class="wide"
          readOnly
          aria-label="Link"
          value={link.value.url}
          onFocus={(event) => event.currentTarget.select()}
        />
      )}
      <h3>A frame file of yours</h3>
      <label class="file">
        Open a .toml file
        <input
          type="file"
          multiple
          accept=".toml"
          onChange={(event) => {
            void openFrame([...(event.currentTarget.files ?? [])]);
            // The same file again, which was changed in the meantime, is a choice, too.
            event.currentTarget.value = "";
          }}
        />
      </label>{" "}
      <span>or drag it onto the page. Its base is a preset, against which its differences are marked.</span>
    </div>
  );
}

async function one(part: string): Promise<void> {
  const of = await asChanged();
  const file = (await made(["stl"], of)).find(({ path }) => path.endsWith(`/${part}.stl`));
  if (file) save(`${part}.stl`, file.bytes);
  else complain(`${of.name} has no part ${part}: it was changed meanwhile.`);
}

async function share(): Promise<void> {
  quiet();
  const of = await asChanged();
  const { preset, name, text } = of;
  const set: Record<string, Setting> = {};
  for (const key of changedKeys.value) {
    const value = valueOf(key);
    if (value !== null) set[key] = value;
  }
  // Comments, entries of one's own, refused values and the like are not among the values: then the text itself is the link.
  const stated = (frame.value?.stated ?? []).filter((key) => key !== "base");
  // The values are those of the picture: while another frame is computed, only its text is known.
  const known = shownDoc.value === of && Object.keys(pending.value).length === 0;
  const whole =
    !isUnchanged(of) && (!known || refused.value !== null || stated.some((key) => !(key in set)) || hasComment(text));
  const fragment = toFragment(
    whole ? { preset, name, set: {}, text } : { preset, name, set: isUnchanged(of) ? {} : set },
  );
  if (fragment.length > LONGEST_LINK) {
    const kb = (length: number) => Math.ceil(length / 1000);
    complain(
      `A link to this frame would have ${kb(fragment.length)} kB, and may have ${kb(LONGEST_LINK)} kB: give away the frame file instead.`,
    );
    return;
  }
  const url = `${location.origin}${location.pathname}#${fragment}`;
  link.value = { of, url };
  try {
    await navigator.clipboard.writeText(url);
    tell("The link is on the clipboard.");
  } catch {
    complain("The link stands below; this browser does not let the page copy it.");
  }
}

// Story 3: every rule beside the model, violated first, the margin as a bar; a click goes to the place.
import { computed, signal } from "@preact/signals";
import type { Finding } from "../engine/answers.ts";
import {
  base,
  catalogue,
  checkAgain,
  checking,
  checksFailure,
  findings,
  findingsAreCurrent,
  findingsAreOfPicture,
  frame,
  refused,
  strengthFailure,
  withStrength,
} from "../state/studio.ts";
import { touched } from "../state/places.ts";
import { standing } from "../state/standing.ts";
import { label, short } from "../ui/words.ts";
import type { BodyFacts } from "../view/body_facts.ts";
import { isDisc } from "../view/body_facts.ts";
import { colourBy, discs, envelope, lit, viewer } from "../view/scene_state.ts";
import { showParameter, showPicture } from "../state/focus.ts";

const opened = signal<Set<string>>(new Set());
const RANK = { violated: 0, warns: 1, holds: 2 };

type Group = { id: string; title: string; sentence: string; of: Finding[]; worst: Finding };

const groups = computed<Group[]>(() => {
  const rules = catalogue.value?.rules ?? [];
  const found = findings.value?.of ?? [];
  const made = rules.flatMap(({ id, title, sentence }) => {
    const of = found
      .filter(({ rule }) => rule === id)
      .sort((a, b) => RANK[standing(a)] - RANK[standing(b)] || share(a) - share(b));
    return of[0] ? [{ id, title, sentence, of, worst: of[0] }] : [];
  });
  return made.sort((a, b) => RANK[standing(a.worst)] - RANK[standing(b.worst)]);
});

/** The margin as a share of the limit: findings of one rule may have several units. */
function share({ margin, limit, value }: Finding): number {
  return margin / (Math.abs(limit) || Math.abs(value) || 1);
}

export function Checks() {
  const all = findings.value;
  const violated = all?.of.filter(({ verdict }) => verdict === "violated").length ?? 0;
  const whose = refused.value ? " of the last good frame" : "";
  return (
    <div class="checks">
      <p class="state" role="status" data-state={all?.all && findingsAreCurrent.value ? "all" : "some"}>
        {!all
          ? "Nothing is checked yet."
          : violated === 0
            ? `Every checked limit${whose} holds.`
            : `${violated} limit${violated === 1 ? "" : "s"}${whose} ${violated === 1 ? "is" : "are"} violated.`}{" "}
        {all && !findingsAreOfPicture.value && "This is of the frame before the last change."}
        {all &&
          findingsAreOfPicture.value &&
          !all.all &&
          (checksFailure.value === null
            ? "Quick checks only; the others are running."
            : "Quick checks only; the others failed.")}
        {checking.value && ` ${checking.value.name} (${checking.value.done + 1} of ${checking.value.of})`}
      </p>
      <Failure words={checksFailure.value} />
      <Strength />
      <ul class={findingsAreCurrent.value ? "" : "old"}>
        {groups.value.map((group) => (
          <Rule key={group.id} group={group} />
        ))}
      </ul>
    </div>
  );
}

/** What takes as long as all other checks, and is asked for. */
function Strength() {
  const known = findings.value?.strength && findingsAreOfPicture.value;
  const failure = strengthFailure.value ?? checksFailure.value;
  const state = !withStrength.value ? "off" : failure !== null ? "failed" : known ? "done" : "computing";
  return (
    <div class="strength" data-strength={state}>
      <label>
        <input
          type="checkbox"
          checked={withStrength}
          onChange={(event) => (withStrength.value = event.currentTarget.checked)}
        />{" "}
        strength, too: a drop by the frame’s own mechanics
      </label>
      <span role="status">{state === "computing" && " – computing…"}</span>
      {state === "failed" && <Failure words={strengthFailure.value} />}
    </div>
  );
}

/** Why something could not be checked, if it could not. */
function Failure({ words }: { words: string | null }) {
  if (words === null) return null;
  return (
    <p class="fault">
      {words}{" "}
      <button type="button" class="link" onClick={checkAgain}>
        Check again
      </button>
    </p>
  );
}

const MARK = { violated: "✗", warns: "!", holds: "✓" };
const WORD = { violated: "violated", warns: "warning", holds: "holds" };

function Rule({ group }: { group: Group }) {
  const open = opened.value.has(group.id);
  const toggle = () => {
    const next = new Set(opened.value);
    if (!next.delete(group.id)) next.add(group.id);
    opened.value = next;
  };
  const bad = group.of.filter((finding) => standing(finding) !== "holds");
  const worst = standing(group.worst);
  const shown = open ? group.of : bad.slice(0, 4);
  return (
    <li class={`rule ${worst}`} data-rule={group.id}>
      <button type="button" class="head" aria-expanded={open} onClick={toggle} title={group.sentence}>
        <span class="mark" aria-label={WORD[worst]} role="img">
          {MARK[worst]}
        </span>
        <span class="title">{group.title}</span>
        <Margin finding={group.worst} />
        <span class="count">{group.of.length}</span>
      </button>
      {open && <p class="about">{group.sentence}</p>}
      {shown.length > 0 && (
        <ul>
          {shown.map((finding) => (
            <Place key={`${finding.subject} ${finding.unit} ${finding.limit}`} finding={finding} />
          ))}
        </ul>
      )}
      {!open && bad.length > shown.length && (
        <button type="button" class="link more" onClick={toggle}>
          and {bad.length - shown.length} more
        </button>
      )}
    </li>
  );
}

/** The bodies and parts that a finding names, or else those that its values drive. */
function bodiesOf({ subject, message, levers }: Finding, facts: BodyFacts[]): Set<string> {
  for (const words of [subject, message]) {
    const named = touched(words, facts);
    if (named.length > 0) return new Set(named);
  }
  const drivers = catalogue.value?.parameters.filter(({ key }) => levers.includes(key)) ?? [];
  return new Set(drivers.flatMap(({ drives }) => drives));
}

/** What is changed of a frame for a lever: the bought part that the lever follows, unless a file states the lever itself. */
function changedFor(lever: string): string {
  const from = catalogue.value?.parameters.find(({ key }) => key === lever)?.follows;
  const stated = [frame.value, base.value].some((read) => read?.stated.includes(lever));
  // Another number that a lever follows has its table before it, a bought part has none.
  return from && !from.includes(".") && !stated ? `bought.${from}` : lever;
}

/** Whether a lever has a field; those of tables that a file adds, such as `extras`, have none. */
function isField(key: string): boolean {
  const { parameters = [], choices = [] } = catalogue.value ?? {};
  return [...parameters, ...choices].some((field) => field.key === key);
}

function Place({ finding }: { finding: Finding }) {
  const go = () => {
    const facts = viewer.value?.facts() ?? [];
    const names = bodiesOf(finding, facts);
    lit.value = names;
    showPicture();
    if (facts.some((body) => isDisc(body) && names.has(body.name))) discs.value = true;
    const ofAll = finding.rule === "envelope";
    if (ofAll) envelope.value = true;
    if (names.size > 0 && !ofAll) viewer.value?.fly(names);
    else viewer.value?.fit();
    if (standing(finding) !== "holds" && colourBy.value === "part") colourBy.value = "finding";
  };
  return (
    <li class={`place ${standing(finding)}`}>
      <button type="button" class="link" onClick={go}>
        {finding.subject}
      </button>
      <Margin finding={finding} />
      <p>{finding.message}</p>
      {finding.verdict === "violated" && finding.levers.length > 0 && (
        <p class="levers">
          Changed most directly by{" "}
          {[...new Set(finding.levers.map(changedFor))].map((key) =>
            isField(key) ? (
              <button key={key} type="button" class="link" onClick={() => showParameter(key)}>
                {label(key)}
              </button>
            ) : (
              <code key={key}>{key}</code>
            ),
          )}
        </p>
      )}
    </li>
  );
}

/** A margin with two decimals, or as many as it takes to tell that a limit is violated. */
function marginWords({ margin, verdict }: Finding): string {
  const rounded = short(margin, 2);
  return verdict === "violated" && Number(rounded) === 0 ? margin.toPrecision(1) : rounded;
}

function Margin({ finding }: { finding: Finding }) {
  if (standing(finding) === "warns") return <span class="margin" />;
  const of = Math.max(-1, Math.min(1, share(finding)));
  return (
    <span class="margin" title={`margin ${short(finding.margin, 2)} ${finding.unit}`}>
      <svg viewBox="-50 0 100 8" preserveAspectRatio="none" aria-hidden="true">
        <rect class="track" x="-50" width="100" height="8" />
        <rect
          class={finding.verdict === "violated" ? "bad" : "good"}
          x={Math.min(0, 50 * of)}
          width={Math.max(1, Math.abs(50 * of))}
          height="8"
        />
        <rect class="limit" x="-0.7" width="1.4" height="8" />
      </svg>
      <span class="figure">
        {finding.margin > 0 ? "+" : ""}
        {marginWords(finding)} {finding.unit}
      </span>
    </span>
  );
}

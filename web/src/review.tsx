// Every specimen, with what speaks against it and a person's word.

import { useEffect, useRef, useState } from "preact/hooks";
import type { Laboratory as Work, LaboratorySpecimen } from "./api";
import { useHandIn } from "./hand_in";
import { gpa, mpa } from "./numbers";
import { Name, Notice, Table, Unit, unusual } from "./parts";

/** The laboratory's note, and who has judged the specimen last and why. */
function remarkOn(s: LaboratorySpecimen): string {
  if (!s.by) return s.note;
  const judged = `${s.by}: ${s.why}`;
  return s.note && s.note !== s.why ? `${s.note}; ${judged}` : judged;
}

export function Specimens({
  work,
  by,
  refresh,
  playing,
}: {
  work: Work;
  by: string;
  refresh: () => Promise<void>;
  playing: boolean;
}) {
  const [judged, setJudged] = useState<string | null>(null);
  const [why, setWhy] = useState("");
  const [find, setFind] = useState("");
  const [said, busy, handIn] = useHandIn(refresh);
  const doubts = new Map(work.groups.flatMap((g) => g.proposed_outliers.map((o) => [o.specimen, o.reasons] as const)));
  const rows = work.specimens
    .filter((s) => `${s.specimen} ${s.design} ${s.test} ${s.batch}`.toLowerCase().includes(find.toLowerCase()))
    .sort((a, b) => Number(doubts.has(b.specimen)) - Number(doubts.has(a.specimen)));
  const reason = useRef<HTMLInputElement>(null);
  useEffect(() => reason.current?.focus(), [judged]);
  /** Another one may be open by now; where none is, the keyboard goes on at the button that opened it. */
  const close = (s: LaboratorySpecimen) => {
    setJudged((now) => (now === s.specimen ? null : now));
    requestAnimationFrame(() => {
      if (document.activeElement === document.body)
        document.querySelector<HTMLElement>(`[aria-label="${CSS.escape(`judge ${s.specimen}`)}"]`)?.focus();
    });
  };
  const judge = async (s: LaboratorySpecimen) => {
    const done = `${s.specimen} is ${s.valid ? "not valid" : "valid"} now.`;
    if (await handIn("/api/review", { specimen: s.specimen, valid: !s.valid, by, why }, done))
      close(s);
  };
  return (
    <section class="panel">
      <h2>Review</h2>
      <div class="row">
        <label>
          Find{" "}
          <input
            type="search"
            value={find}
            onInput={(e) => setFind(e.currentTarget.value)}
            placeholder="specimen, design, test or batch"
          />
        </label>
      </div>
      <Notice said={said} />
      <Table
        name="specimens"
        caption={`Specimens (${find ? `${rows.length} of ` : ""}${work.specimens.length})`}
        rows={rows}
        rowKey={(s) => s.specimen}
        empty={find ? "No specimen is called so." : "Nothing has been measured yet."}
        rowClass={(s) => (s.valid ? "" : "invalid")}
        columns={[
          { heading: "specimen", words: true, show: (s) => s.specimen, value: (s) => s.specimen },
          {
            heading: "design",
            words: true,
            show: (s) => (
              <span class="with-unit">
                <Unit design={s.design} size={22} label={false} />
                <Name design={s.design} />
              </span>
            ),
            value: (s) => s.design,
          },
          {
            heading: "test",
            words: true,
            show: (s) => `${s.test}${unusual(s)}`,
            value: (s) => s.test,
          },
          { heading: "orientation_deg", value: (s) => s.orientation_deg },
          { heading: "strain_rate_per_s", value: (s) => s.strain_rate_per_s },
          { heading: "thickness_mm", value: (s) => s.thickness_mm },
          { heading: "batch", value: (s) => s.batch },
          { heading: "E / GPa", csv: "modulus_pa", show: (s) => gpa(s.modulus_pa), value: (s) => s.modulus_pa },
          { heading: "T / MPa", csv: "toughness_pa", show: (s) => mpa(s.toughness_pa), value: (s) => s.toughness_pa },
          {
            heading: "valid",
            words: true,
            show: (s) => (
              <span class={`chip ${s.valid ? "approved" : "rejected"}`}>{s.valid ? "valid" : "not valid"}</span>
            ),
            value: (s) => s.valid,
          },
          {
            heading: "remarks",
            csv: "note",
            words: true,
            show: (s) => (
              <>
                {doubts.get(s.specimen)?.map((r) => (
                  <span key={r} class="doubt">
                    {r}
                  </span>
                ))}{" "}
                <span class="quiet">{remarkOn(s)}</span>
              </>
            ),
            value: (s) => s.note,
          },
          { heading: "by", value: (s) => s.by },
          { heading: "why", value: (s) => s.why },
          {
            heading: "judge",
            words: true,
            show: (s) =>
              !playing ? (
                ""
              ) : judged === s.specimen ? (
                <form
                  class="judge"
                  onSubmit={(e) => {
                    e.preventDefault();
                    void judge(s);
                  }}
                >
                  <input
                    required
                    ref={reason}
                    aria-label={`why ${s.specimen} is ${s.valid ? "not valid" : "valid"}`}
                    placeholder="why"
                    value={why}
                    maxLength={200}
                    onInput={(e) => setWhy(e.currentTarget.value)}
                  />
                  <button type="submit" disabled={busy || !by}>
                    {s.valid ? "not valid" : "valid"}
                  </button>
                  <button type="button" class="quiet" onClick={() => close(s)}>
                    cancel
                  </button>
                </form>
              ) : (
                <button
                  type="button"
                  class="quiet"
                  onClick={() => {
                    setJudged(s.specimen);
                    setWhy(doubts.get(s.specimen)?.[0]?.slice(0, 200) ?? "");
                  }}
                  aria-label={`judge ${s.specimen}`}
                >
                  judge
                </button>
              ),
          },
        ]}
      />
    </section>
  );
}

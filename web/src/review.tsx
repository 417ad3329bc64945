// Every specimen, with what looks wrong about it, and a person's review.

import { useEffect, useRef, useState } from "preact/hooks";
import type { Laboratory, LaboratorySpecimen } from "./api";
import { AmendmentForm } from "./amendment_form";
import { gpa, mpa } from "./numbers";
import { Name, Notice, Table, Unit, unusual, type Column, type NoticeText } from "./parts";
import { ReplicateCurves } from "./replicate_curves";
import { addressOf } from "./route";
import { useSubmit } from "./submit";
import { TERMS } from "./terms";

/** What the specimen was before its last amendment, where that differs. */
function earlierInWords(s: LaboratorySpecimen): string {
  const was = s.earlier[s.earlier.length - 1];
  const parts = [
    was.design !== s.design && was.design,
    was.test !== s.test && was.test,
    was.modulus_pa !== s.modulus_pa && was.modulus_pa !== null && `E ${gpa(was.modulus_pa)} GPa`,
    was.toughness_pa !== s.toughness_pa && was.toughness_pa !== null && `T ${mpa(was.toughness_pa)} MPa`,
    was.thickness_mm !== s.thickness_mm && `${was.thickness_mm} mm`,
    was.strain_rate_per_s !== s.strain_rate_per_s && `${was.strain_rate_per_s} /s`,
    was.orientation_deg !== s.orientation_deg && `at ${was.orientation_deg}°`,
  ].filter(Boolean);
  return parts.length > 0 ? ` (it was ${parts.join(", ")})` : "";
}

/** The laboratory's note, who amended the specimen last, who reviewed it last, and why. */
function remarkOn(s: LaboratorySpecimen): string {
  const amended = s.amended_by && `amended by ${s.amended_by}: ${s.amended_why}${earlierInWords(s)}`;
  const review = s.by && `${s.by}: ${s.why}`;
  const note = s.note !== s.why && s.note;
  return [note, amended, review].filter(Boolean).join("; ");
}

export function Specimens({
  laboratory,
  by,
  refresh,
  playing,
  isOver,
  chosen,
}: {
  laboratory: Laboratory;
  by: string;
  refresh: () => Promise<void>;
  playing: boolean;
  isOver: boolean;
  /** The specimen that somebody was led to. */
  chosen?: string;
}) {
  const [reviewed, setReviewed] = useState<string | null>(null);
  const [why, setWhy] = useState("");
  const [amended, setAmended] = useState<string | null>(null);
  const [fault, setFault] = useState<NoticeText | null>(null);
  const [notice, busy, submit] = useSubmit(refresh);
  const specimenToAmend = laboratory.specimens.find((s) => s.specimen === amended);
  const doubts = new Map(
    laboratory.groups.flatMap((g) => g.proposed_outliers.map((o) => [o.specimen, o.reasons] as const)),
  );
  const doubtful = (s: LaboratorySpecimen) => Number(doubts.has(s.specimen));
  const rows = [...laboratory.specimens].sort((a, b) => doubtful(b) - doubtful(a));
  const reason = useRef<HTMLInputElement>(null);
  useEffect(() => reason.current?.focus(), [reviewed]);
  /** Another one may be open by now; where none is, the keyboard goes on at the button that opened it. */
  const close = (s: LaboratorySpecimen) => {
    setReviewed((now) => (now === s.specimen ? null : now));
    requestAnimationFrame(() => {
      if (document.activeElement === document.body)
        document.querySelector<HTMLElement>(`[aria-label="${CSS.escape(`review ${s.specimen}`)}"]`)?.focus();
    });
  };
  const review = async (s: LaboratorySpecimen) => {
    const done = `${s.specimen} is ${s.valid ? "not valid" : "valid"} now.`;
    if (await submit("/api/review", { specimen: s.specimen, valid: !s.valid, by, why }, done)) close(s);
  };
  const reviewColumn: Column<LaboratorySpecimen> = {
    ...TERMS.review,
    words: true,
    show: (s) =>
      reviewed === s.specimen ? (
        <form
          class="review"
          onSubmit={(e) => {
            e.preventDefault();
            void review(s);
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
        <span class="buttons">
          <button
            type="button"
            class="quiet"
            onClick={() => {
              setReviewed(s.specimen);
              setWhy(doubts.get(s.specimen)?.[0]?.slice(0, 200) ?? "");
            }}
            aria-label={`review ${s.specimen}`}
          >
            review
          </button>
          <button
            type="button"
            class="quiet"
            onClick={() => {
              setAmended(s.specimen);
              setFault(null);
            }}
            aria-label={`amend ${s.specimen}`}
          >
            amend
          </button>
        </span>
      ),
  };
  return (
    <section class="panel">
      <h2>Specimens</h2>
      {playing && specimenToAmend && (
        <AmendmentForm
          key={amended}
          specimen={specimenToAmend}
          by={by}
          busy={busy}
          submit={(body, done, explain) => (setFault(null), submit("/api/amendment", body, done, explain))}
          close={() => setAmended(null)}
          say={setFault}
        />
      )}
      <Notice notice={fault ?? notice} />
      <Table
        name="specimens"
        caption={`Review (${rows.length} specimens)`}
        rows={rows}
        rowKey={(s) => s.specimen}
        empty={isOver ? "Nothing was measured." : "Nothing has been measured yet."}
        chosen={chosen}
        rowClass={(s) => (s.valid ? "" : "invalid")}
        detail={(s) =>
          reviewed === s.specimen &&
          chosen !== s.specimen && ( // whose page has its curve above
            <div class="replicates">
              <ReplicateCurves of={s} version={s.valid} />
            </div>
          )
        }
        columns={[
          {
            heading: "specimen",
            words: true,
            show: (s) => (
              <>
                <a href={addressOf("laboratory", { specimen: s.specimen })}>{s.specimen}</a>
                <span class="narrow quiet">{`${s.test}${unusual(s)}`}</span>
                {doubts.has(s.specimen) && <span class="narrow doubt">out of line</span>}
              </>
            ),
            value: (s) => s.specimen,
          },
          {
            ...TERMS.design,
            words: true,
            minor: true,
            show: (s) => (
              <span class="with-unit">
                <Unit design={s.design} size={22} label={false} />
                <Name design={s.design} />
              </span>
            ),
            value: (s) => s.design,
          },
          {
            ...TERMS.test,
            words: true,
            minor: true,
            show: (s) => `${s.test}${unusual(s)}`,
            value: (s) => s.test,
          },
          { heading: "orientation_deg", value: (s) => s.orientation_deg },
          { heading: "strain_rate_per_s", value: (s) => s.strain_rate_per_s },
          { heading: "thickness_mm", value: (s) => s.thickness_mm },
          { heading: "batch", value: (s) => s.batch },
          { ...TERMS.oneModulus, csv: "modulus_pa", show: (s) => gpa(s.modulus_pa), value: (s) => s.modulus_pa },
          {
            ...TERMS.oneToughness,
            csv: "toughness_pa",
            show: (s) => mpa(s.toughness_pa),
            value: (s) => s.toughness_pa,
          },
          {
            ...TERMS.specimenValid,
            words: true,
            show: (s) => (
              <span class={`chip ${s.valid ? "approved" : "rejected"}`}>{s.valid ? "valid" : "not valid"}</span>
            ),
            value: (s) => s.valid,
          },
          {
            ...TERMS.remarks,
            csv: "note",
            words: true,
            minor: true,
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
            order: (s) => (doubtful(s) ? "0" : "1") + remarkOn(s),
          },
          { heading: "by", value: (s) => s.by },
          { heading: "why", value: (s) => s.why },
          { heading: "amended_by", value: (s) => s.amended_by },
          { heading: "amended_why", value: (s) => s.amended_why },
          ...(playing ? [reviewColumn] : []),
        ]}
      />
    </section>
  );
}

// What is proposed for the laboratory, to be decided on, and designs of one's own.

import type { Family, Laboratory as Work, Proposed } from "./api";
import { useHandIn } from "./hand_in";
import { gpa, mpa } from "./numbers";
import { Name, Notice, Unit, useDraft } from "./parts";

/** Designs that may wait for a decision: of a round, or of the families of the stage after the last one. */
interface Offer {
  title: string;
  round: number;
  designs: Proposed[];
  /** No round follows that would measure them. */
  isLate: boolean;
}

/** The stage's variants while they are measured, else the newest proposal. */
export function offerOf(work: Work, stage: Family[], lastRound: number): Offer | null {
  const open = stage.filter((f) => !f.is_validated);
  if (open.length > 0)
    return {
      title: "Variants of the families",
      round: open[0].round,
      isLate: false,
      designs: open.flatMap((f) =>
        f.designs
          .filter((d) => !d.is_seed)
          .map((d) => ({
            design: d.design,
            modulus_pa: d.family_model.modulus_pa ?? NaN,
            toughness_pa: d.family_model.toughness_pa ?? NaN,
            reason: `chosen of the variants of ${f.name}, by its own model`,
          })),
      ),
    };
  const { proposal } = work;
  return proposal && { title: `Proposal of round ${proposal.round}`, isLate: proposal.round >= lastRound, ...proposal };
}

/** What becomes of the designs that are offered. */
function outlook(offer: Offer, waits: boolean, approval: boolean): string {
  if (offer.isLate) return "Proposed after the last round: nothing of this is measured any more.";
  if (!approval) return "This game does not wait for a person's yes.";
  return waits ? "The game waits for a yes or no to each design." : "";
}

export function Proposals({
  work,
  offer,
  by,
  refresh,
  playing,
  approval,
}: {
  work: Work;
  offer: Offer | null;
  by: string;
  refresh: () => Promise<void>;
  playing: boolean;
  approval: boolean;
}) {
  const [why, setWhy] = useDraft("decision/why", "");
  const [own, setOwn] = useDraft("decision/own", "");
  const [said, busy, handIn] = useHandIn(refresh);
  const stateOf = (design: string) => work.designs.find((d) => d.design === design);
  /** The reason goes with one decision; the next one has its own. */
  const say = async (design: string, round: number, approved: boolean, done: string) => {
    const isTaken = await handIn("/api/approval", { design, round, approved, by, why }, done);
    if (isTaken) setWhy((now) => (now === why ? "" : now));
    return isTaken;
  };
  const decide = (design: string, approved: boolean) =>
    say(design, offer!.round, approved, `${design} ${approved ? "approved" : "rejected"}.`);
  const isOpen = (design: string) => (stateOf(design)?.state ?? "pending") === "pending";
  if (!offer)
    return (
      <section class="panel">
        <h2>Proposals</h2>
        <p class="awaited">There is no proposal yet.</p>
      </section>
    );
  const waits = approval && playing && !offer.isLate && offer.designs.some((p) => isOpen(p.design));
  return (
    <section class="panel">
      <h2>{offer.title}</h2>
      <p class="quiet">{outlook(offer, waits, approval)}</p>
      <ul class="cards">
        {offer.designs.map((p) => {
          const state = stateOf(p.design);
          return (
            <li key={p.design} class="card">
              <Unit design={p.design} size={92} />
              <div>
                <Name design={p.design} />
                <p>
                  E {gpa(p.modulus_pa)} GPa · T {mpa(p.toughness_pa)} MPa
                </p>
                <p class="quiet">{p.reason}</p>
                <p>
                  <span class={`chip ${state?.state ?? "pending"}`}>{state?.state ?? "pending"}</span>{" "}
                  {state?.by && (
                    <span class="quiet">
                      {state.by}
                      {state.why && `: ${state.why}`}
                    </span>
                  )}
                </p>
                {waits && isOpen(p.design) && (
                  <div class="buttons">
                    <button type="button" disabled={busy || !by} onClick={() => decide(p.design, true)}>
                      Approve
                    </button>
                    <button type="button" class="quiet" disabled={busy || !by} onClick={() => decide(p.design, false)}>
                      Reject
                    </button>
                  </div>
                )}
              </div>
            </li>
          );
        })}
      </ul>
      {playing && (
        <div class="row">
          <label>
            Why{" "}
            <input
              value={why}
              maxLength={200}
              onInput={(e) => setWhy(e.currentTarget.value)}
              placeholder="kept with the decision"
            />
          </label>
          <label>
            A design of your own{" "}
            <input
              value={own}
              maxLength={101}
              spellcheck={false}
              onInput={(e) => setOwn(e.currentTarget.value.trim())}
              placeholder="key of 14 hex digits"
            />
          </label>
          <button
            type="button"
            disabled={busy || !own || !by}
            onClick={async () => {
              if (await say(own, -1, true, `${own} will be measured.`)) setOwn("");
            }}
          >
            Have it measured
          </button>
        </div>
      )}
      <Notice said={said} />
    </section>
  );
}

// Designs proposed for the laboratory, to be approved or rejected, and designs of a person's own.

import type { Family, Laboratory, Proposed } from "./api";
import { gpa, MPA, mpa, percent, sentence, withError } from "./numbers";
import { PriceOfRound } from "./next_round";
import { useDraft } from "./kept_draft";
import { DesignChip, MaterialKey, Name, Notice, Reason, Unit } from "./parts";
import { useSubmit } from "./submit";

/** A design; those of the family stage have no scatter. */
type Offered = Pick<Proposed, "design" | "modulus_pa" | "toughness_pa" | "reason"> & Partial<Proposed>;

/** Designs that may wait for an approval: of a round, or of the family stage after the last one. */
interface Offer {
  title: string;
  round: number;
  designs: Offered[];
  /** No round follows that would measure them. */
  isLate: boolean;
}

/** The stage's variants while they are measured, else the newest proposal. */
export function offerOf(laboratory: Laboratory, stage: Family[], lastRound: number): Offer | null {
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
            reason:
              `near the best predicted toughness for its stiffness among the variants of ${f.name}, ` +
              "with the family's own model",
          })),
      ),
    };
  const { proposal } = laboratory;
  if (!proposal) return proposal;
  return { title: `Proposals of round ${proposal.round}`, isLate: proposal.round >= lastRound, ...proposal };
}

/** What happens to the designs of an offer. */
function outlook(offer: Offer, waits: boolean, approval: boolean): string {
  if (offer.isLate) return "Proposed after the last round: these designs are not measured any more.";
  if (!approval) return "This game does not wait for approval: what is proposed is ordered.";
  return waits ? "The game waits: approve or reject each design." : "";
}

/** With its standard error and scatter, where it is the mean of several specimens. */
function predictedToughness({ toughness_pa, toughness_sd_pa = 0, specimens = 0 }: Offered): string {
  if (specimens < 2) return `${mpa(toughness_pa)} MPa`;
  const mean = withError(toughness_pa * MPA, (toughness_sd_pa * MPA) / Math.sqrt(specimens));
  return `${mean} MPa (mean of ${specimens} specimens, scatter ${percent(toughness_sd_pa / toughness_pa)})`;
}

export function Proposals({
  laboratory,
  offer,
  by,
  refresh,
  playing,
  approval,
  hasPrice,
  isOver,
}: {
  laboratory: Laboratory;
  offer: Offer | null;
  by: string;
  refresh: () => Promise<void>;
  playing: boolean;
  approval: boolean;
  /** People print and test what it proposes. */
  hasPrice: boolean;
  isOver: boolean;
}) {
  const [why, setWhy] = useDraft("approval/why", "");
  const [own, setOwn] = useDraft("approval/own", "");
  const [notice, busy, submit] = useSubmit(refresh);
  const stateOf = (design: string) => laboratory.designs.find((d) => d.design === design);
  /** The reason goes with one approval; the next one has its own. */
  const approve = async (design: string, round: number, approved: boolean, done: string) => {
    const isTaken = await submit("/api/approval", { design, round, approved, by, why }, done, sentence);
    if (isTaken) setWhy((now) => (now === why ? "" : now));
    return isTaken;
  };
  const approveOrReject = (design: string, approved: boolean) =>
    approve(design, offer!.round, approved, `${design} is ${approved ? "approved" : "rejected"}.`);
  /** What is open of a design's orders is withdrawn, for the reason that is typed below. */
  const withdraw = async (design: string) => {
    const done = `${design} is withdrawn: the round closes without it.`;
    if (await submit("/api/withdrawal", { design, withdrawn: true, by, why }, done, sentence)) setWhy("");
  };
  const giveAgain = (design: string) =>
    submit("/api/withdrawal", { design, withdrawn: false, by, why }, `${design} is open again.`, sentence);
  const newest = Math.max(...laboratory.orders.map((o) => o.round));
  const hasOrder = (design: string, withdrawn: boolean) =>
    laboratory.orders.some(
      (o) => o.design === design && o.round === newest && !o.complete && o.withdrawn === withdrawn,
    );
  const price = hasPrice && <PriceOfRound price={laboratory.price} />;
  const isOpen = (design: string) => (stateOf(design)?.state ?? "pending") === "pending";
  if (!offer)
    return (
      <section class="panel">
        <h2>Proposals</h2>
        <p class="awaited">
          {isOver ? "Nothing was proposed." : "There is no proposal yet: the first one follows the first search."}
        </p>
        {price}
      </section>
    );
  const waits = approval && playing && !offer.isLate && offer.designs.some((p) => isOpen(p.design));
  return (
    <section class="panel">
      <div class="panel-head">
        <h2>{offer.title}</h2>
        <MaterialKey />
      </div>
      <p class="quiet">{outlook(offer, waits, approval)}</p>
      {price}
      <ul class="cards">
        {offer.designs.map((p) => {
          const state = stateOf(p.design);
          return (
            <li key={p.design} class="card">
              <Unit design={p.design} size={92} />
              <div>
                <Name design={p.design} />
                <p>
                  Predicted: E {gpa(p.modulus_pa)} GPa, T {predictedToughness(p)}
                </p>
                <Reason text={p.reason} />
                <p>
                  <DesignChip state={state?.state ?? "pending"} waits={waits} />{" "}
                  {state?.by && (
                    <span class="quiet">
                      {state.by}
                      {state.why && `: ${state.why}`}
                    </span>
                  )}
                </p>
                {waits && isOpen(p.design) && (
                  <div class="buttons">
                    <button type="button" disabled={busy || !by} onClick={() => approveOrReject(p.design, true)}>
                      Approve
                    </button>
                    <button
                      type="button"
                      class="quiet"
                      disabled={busy || !by}
                      onClick={() => approveOrReject(p.design, false)}
                    >
                      Reject
                    </button>
                  </div>
                )}
                {playing && hasOrder(p.design, false) && (
                  <button
                    type="button"
                    class="quiet"
                    disabled={busy || !by || !why}
                    title={why ? "" : "Say below why it cannot be made"}
                    onClick={() => withdraw(p.design)}
                  >
                    Withdraw
                  </button>
                )}
                {playing && hasOrder(p.design, true) && (
                  <button type="button" class="quiet" disabled={busy || !by} onClick={() => giveAgain(p.design)}>
                    Undo the withdrawal
                  </button>
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
              placeholder="kept with what you decide"
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
              if (await approve(own, -1, true, `${own} will be measured.`)) setOwn("");
            }}
          >
            Have it measured
          </button>
        </div>
      )}
      <Notice notice={notice} />
    </section>
  );
}

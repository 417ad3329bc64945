// What one does with a design that one has found: have it measured, or keep it on the shortlist.

import { useState } from "preact/hooks";
import { useApprovals } from "./approvals";
import { useApprover } from "./approver";
import { sentence } from "./numbers";
import { Notice, Problem } from "./parts";
import { addressOf } from "./route";
import { useOpenRun } from "./run_context";
import { useShortlist, type Listed } from "./shortlist";
import { useSubmit } from "./submit";

function MeasureForm({ design, data, close }: { design: string; data: string | null; close: () => void }) {
  const run = useOpenRun()!;
  const approvals = useApprovals(data);
  const { by, why, fields } = useApprover(run.user);
  const [notice, busy, submit] = useSubmit(approvals.read);
  const state = approvals.stateOf(design);
  const [isDone, setDone] = useState(false);
  const order = async () => {
    const body = { design, round: approvals.roundOf(design), approved: true, by, why };
    setDone(await submit("/api/approval", body, `${design} will be measured.`, sentence));
  };
  return (
    <>
      <Problem text={approvals.problem} />
      {!isDone && (
        <form
          class="row"
          onSubmit={(e) => {
            e.preventDefault();
            void order();
          }}
        >
          {fields}
          <button type="submit" disabled={busy || !by || !approvals.isRead}>
            Order it
          </button>
          <button type="button" class="quiet" onClick={close}>
            cancel
          </button>
        </form>
      )}
      {state && <p class="quiet">The laboratory knows it: {state}.</p>}
      <Notice notice={notice} />
    </>
  );
}

/** `listed`: the design as the shortlist would have it. */
export function Measure({ listed, data }: { listed: Listed; data: string | null }) {
  const run = useOpenRun();
  const shortlist = useShortlist();
  const [isOpen, setOpen] = useState(false);
  const { design } = listed;
  if (!run) return null;
  const isListed = shortlist.has(design);
  return (
    <div class="measure">
      <div class="buttons">
        {run.playing && (
          <button type="button" aria-expanded={isOpen} onClick={() => setOpen(!isOpen)}>
            Have it measured
          </button>
        )}
        <button
          type="button"
          class="quiet"
          aria-pressed={isListed}
          onClick={() => (isListed ? shortlist.remove([design]) : shortlist.add([listed]))}
        >
          {isListed ? "off the shortlist" : "onto the shortlist"}
        </button>
        {/^[0-9a-f]{14}$/.test(design) && (
          <a class="quiet" href={addressOf("editor", { design })}>
            edit
          </a>
        )}
      </div>
      {isOpen && run.playing && <MeasureForm design={design} data={data} close={() => setOpen(false)} />}
    </div>
  );
}

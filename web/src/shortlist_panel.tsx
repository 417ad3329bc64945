// The shortlist: looked at, cut, saved as a file that `nacre approve` reads, and approved.

import { useState } from "preact/hooks";
import { approveEach, useApprovals, type Approved } from "./approvals";
import { useApprover } from "./approver";
import { gpa, mpa, percent } from "./numbers";
import { Name, Notice, Problem, Table, Unit, type Column, type NoticeText } from "./parts";
import { useOpenRun } from "./run_context";
import { useShortlist, type Listed } from "./shortlist";
import { TERMS } from "./terms";

const designs = (count: number) => `${count} ${count === 1 ? "design" : "designs"}`;

/** What came of it, in sentences. */
function noticeOf({ taken, refused, stopped }: Approved): NoticeText {
  const said = [
    taken.length > 0 && `${designs(taken.length)} will be measured.`,
    ...refused.slice(0, 5).map(({ reason }) => `${reason}.`.replace(/\.\.$/, ".")),
    refused.length > 5 && `So it is with ${refused.length - 5} more.`,
    stopped,
  ].filter(Boolean);
  return { kind: refused.length || stopped ? "bad" : "good", text: said.join(" ") };
}

function ApproveAll({ list, data }: { list: Listed[]; data: string | null }) {
  const run = useOpenRun()!;
  const approvals = useApprovals(data);
  const shortlist = useShortlist();
  const { by, why, fields } = useApprover(run.user);
  const [notice, setNotice] = useState<NoticeText | null>(null);
  const [busy, setBusy] = useState(false);
  const approve = async () => {
    setBusy(true);
    const say = (done: number) => setNotice({ kind: "busy", text: `approving ${done + 1} of ${list.length} …` });
    const result = await approveEach(list.map((each) => each.design), approvals.roundOf, { by, why }, say);
    shortlist.remove(result.taken);
    setNotice(noticeOf(result));
    setBusy(false);
    await approvals.read();
  };
  return (
    <>
      <Problem text={approvals.problem} />
      {list.length > 0 && (
        <div class="row">
          {fields}
          <button type="button" disabled={busy || !by || !approvals.isRead} onClick={() => void approve()}>
            Approve {list.length === 1 ? "it" : `all ${list.length}`}
          </button>
        </div>
      )}
      <Notice notice={notice} />
    </>
  );
}

const AS_CHOSEN = "As it was when the design was chosen.";

export function ShortlistPanel({ data, choose }: { data: string | null; choose: (design: string) => void }) {
  const run = useOpenRun();
  const { list, remove } = useShortlist();
  if (!run) return null;
  const columns: Column<Listed>[] = [
    {
      ...TERMS.design,
      words: true,
      show: ({ design }) => (
        <button type="button" class="link with-unit" onClick={() => choose(design)}>
          <Unit design={design} size={22} label={false} />
          <Name design={design} />
        </button>
      ),
      value: (d) => d.design,
    },
    {
      ...TERMS.oneModulus,
      hint: AS_CHOSEN,
      csv: "modulus_pa",
      show: (d) => gpa(d.modulus_pa),
      value: (d) => d.modulus_pa,
    },
    {
      ...TERMS.oneToughness,
      hint: AS_CHOSEN,
      csv: "toughness_pa",
      show: (d) => mpa(d.toughness_pa),
      value: (d) => d.toughness_pa,
    },
    {
      ...TERMS.rigid,
      csv: "rigid_fraction",
      show: (d) => percent(d.rigid_fraction, 0),
      value: (d) => d.rigid_fraction,
    },
    { heading: "found", words: true, show: (d) => d.of, value: (d) => d.of },
    {
      heading: "remove",
      show: ({ design }) => (
        <button type="button" class="quiet" aria-label={`remove ${design}`} onClick={() => remove([design])}>
          remove
        </button>
      ),
    },
  ];
  return (
    <section class="panel" aria-label="shortlist">
      <Table
        name="shortlist"
        caption="Shortlist"
        rows={list}
        rowKey={(d) => d.design}
        empty="Nothing is on it yet. Choose designs below the gamut, or in the panel of a design."
        columns={columns}
      />
      {list.length > 0 && (
        <p class="quiet">
          Kept in this browser. Its CSV goes to the command line: <code>nacre approve --shortlist FILE</code>.{" "}
          <button type="button" class="quiet" onClick={() => remove(list.map((d) => d.design))}>
            empty the list
          </button>
        </p>
      )}
      {run.playing && <ApproveAll list={list} data={data} />}
    </section>
  );
}

// Orders of the round that is measured: what cannot be made is withdrawn, and given again.

import { useEffect, useRef, useState } from "preact/hooks";
import type { Laboratory, Order } from "./api";
import { Name, Notice, Table, Unit, unusual, type Column } from "./parts";
import { useSubmit } from "./submit";
import { TERMS } from "./terms";

/** Those of the newest round that are not complete. */
const changeable = ({ orders }: Laboratory) => {
  const newest = Math.max(...orders.map((o) => o.round));
  return orders.filter((o) => o.round === newest && !o.complete);
};

const inWords = (o: Order) => `${o.test}${unusual(o)}${o.loading === "monotonic" ? "" : ` (${o.loading})`}`;

const columns: Column<Order>[] = [
  { heading: "order", value: (o) => o.order },
  {
    ...TERMS.design,
    words: true,
    show: (o) => (
      <span class="with-unit">
        <Unit design={o.design} size={22} label={false} />
        <Name design={o.design} />
      </span>
    ),
    value: (o) => o.design,
  },
  { ...TERMS.test, words: true, show: inWords, value: (o) => o.test },
  {
    ...TERMS.arrivedOf,
    minor: true,
    csv: "arrived",
    show: (o) => `${o.arrived} of ${o.replicates}`,
    value: (o) => o.arrived,
  },
  { heading: "replicates", value: (o) => o.replicates },
  {
    ...TERMS.orderState,
    words: true,
    minor: true,
    show: (o) => (
      <>
        <span class={`chip ${o.withdrawn ? "rejected" : "pending"}`}>{o.withdrawn ? "withdrawn" : "open"}</span>{" "}
        {o.by && <span class="quiet">{`${o.by}${o.why && `: ${o.why}`}`}</span>}
      </>
    ),
    value: (o) => (o.withdrawn ? "withdrawn" : "open"),
  },
  { heading: "by", value: (o) => o.by },
  { heading: "why", value: (o) => o.why },
];

export function Orders({
  laboratory,
  by,
  refresh,
}: {
  laboratory: Laboratory;
  by: string;
  refresh: () => Promise<void>;
}) {
  const [chosen, setChosen] = useState<string | null>(null);
  const [why, setWhy] = useState("");
  const [notice, busy, submit] = useSubmit(refresh);
  const reason = useRef<HTMLInputElement>(null);
  useEffect(() => reason.current?.focus(), [chosen]);
  const rows = changeable(laboratory);
  const say = async (o: Order, withdrawn: boolean) => {
    const done = `${o.order} is ${withdrawn ? "withdrawn: the round closes without it" : "open again"}.`;
    const isTaken = await submit("/api/withdrawal", { order: o.order, withdrawn, by, why: withdrawn ? why : "" }, done);
    if (isTaken) setChosen((now) => (now === o.order ? null : now));
  };
  const action: Column<Order> = {
    ...TERMS.withdraw,
    words: true,
    show: (o) =>
      o.withdrawn ? (
        <button type="button" class="quiet" disabled={busy || !by} onClick={() => say(o, false)}>
          undo
        </button>
      ) : chosen === o.order ? (
        <form
          class="review"
          onSubmit={(e) => {
            e.preventDefault();
            void say(o, true);
          }}
        >
          <input
            required
            ref={reason}
            aria-label={`why ${o.order} is withdrawn`}
            placeholder="why"
            value={why}
            maxLength={200}
            onInput={(e) => setWhy(e.currentTarget.value)}
          />
          <button type="submit" disabled={busy || !by}>
            withdraw
          </button>
          <button type="button" class="quiet" onClick={() => setChosen(null)}>
            cancel
          </button>
        </form>
      ) : (
        <button
          type="button"
          class="quiet"
          aria-label={`withdraw ${o.order}`}
          onClick={() => {
            setChosen(o.order);
            setWhy("");
          }}
        >
          withdraw
        </button>
      ),
  };
  if (rows.length === 0) return notice && <Notice notice={notice} />;
  return (
    <section class="panel">
      <Table
        name="orders"
        caption="Open orders: the round is measured once each is complete or withdrawn"
        rows={rows}
        rowKey={(o) => o.order}
        empty=""
        columns={[...columns, action]}
      />
      <Notice notice={notice} />
    </section>
  );
}

// The laboratory's work: decide on proposals, enter measurements, judge specimens.

import { useState } from "preact/hooks";
import { get, post, Refusal, type DesignState, type Group, type Laboratory as Work, type LaboratorySpecimen, type Order, type RunInfo } from "./api";
import { gpa, mpa, percent } from "./numbers";
import { Name, Notice, Table, Unit, useRepeated, useStored, type Said } from "./parts";

type Answer = { answer: string };

/** Hands something in and says what came of it. */
function useHandIn(refresh: () => Promise<void>): [Said | null, boolean, (path: string, body: unknown, done: string) => Promise<boolean>] {
  const [said, setSaid] = useState<Said | null>(null);
  const [busy, setBusy] = useState(false);
  const handIn = async (path: string, body: unknown, done: string) => {
    setBusy(true);
    setSaid({ kind: "busy", text: "waiting for the validation agent …" });
    try {
      const { answer } = await post<Answer>(path, body);
      setSaid({ kind: "good", text: answer === "repeated" ? "The run has this already." : done });
      await refresh();
      return true;
    } catch (error) {
      setSaid({ kind: "bad", text: error instanceof Refusal ? error.message : "the server does not answer" });
      return false;
    } finally {
      setBusy(false);
    }
  };
  return [said, busy, handIn];
}

function Proposals({ work, by, refresh, playing, approval }: { work: Work; by: string; refresh: () => Promise<void>; playing: boolean; approval: boolean }) {
  const [why, setWhy] = useState("");
  const [own, setOwn] = useState("");
  const [said, busy, handIn] = useHandIn(refresh);
  const stateOf = (design: string) => work.designs.find((d) => d.design === design);
  const decide = (design: string, approved: boolean) => handIn("/api/approval", { design, round: work.proposal!.round, approved, by, why }, `${design} ${approved ? "approved" : "rejected"}.`);
  if (!work.proposal) return <section class="panel"><h2>Proposals</h2><p class="awaited">There is no proposal yet.</p></section>;
  return (
    <section class="panel">
      <h2>Proposal of round {work.proposal.round}</h2>
      <p class="quiet">{approval ? "The game waits for a yes or no to each design." : "This game does not wait for a person's yes; a no still keeps a design from being measured when it comes in time."}</p>
      <ul class="cards">
        {work.proposal.designs.map((p) => {
          const state = stateOf(p.design);
          const open = state === undefined || state.state === "pending";
          return (
            <li key={p.design} class="card">
              <Unit design={p.design} size={92} />
              <div>
                <Name design={p.design} />
                <p>E {gpa(p.modulus_pa)} GPa · T {mpa(p.toughness_pa)} MPa</p>
                <p class="quiet">{p.reason}</p>
                <p><span class={`chip ${state?.state ?? "pending"}`}>{state?.state ?? "pending"}</span> {state?.by && <span class="quiet">{state.by}{state.why && `: ${state.why}`}</span>}</p>
                {open && playing && (
                  <div class="buttons">
                    <button type="button" disabled={busy || !by} onClick={() => decide(p.design, true)}>Approve</button>
                    <button type="button" class="quiet" disabled={busy || !by} onClick={() => decide(p.design, false)}>Reject</button>
                  </div>
                )}
              </div>
            </li>
          );
        })}
      </ul>
      {playing && (
        <div class="row">
          <label>Why <input value={why} maxLength={200} onInput={(e) => setWhy(e.currentTarget.value)} placeholder="kept with the decision" /></label>
          <label>A design of your own <input value={own} maxLength={101} spellcheck={false} onInput={(e) => setOwn(e.currentTarget.value.trim())} placeholder="key of 14 hex digits" /></label>
          <button type="button" disabled={busy || !own || !by} onClick={async () => { if (await handIn("/api/approval", { design: own, round: -1, approved: true, by, why }, `${own} will be measured.`)) setOwn(""); }}>Have it measured</button>
        </div>
      )}
      <Notice said={said} />
    </section>
  );
}

const EMPTY = { specimen: "", pattern: "", test: "toughness", value: "", batch: "", orientation_deg: "0", strain_rate_per_s: "", thickness_mm: "", note: "", valid: true, curve_csv: "" };

function Entry({ work, refresh, playing }: { work: Work; refresh: () => Promise<void>; playing: boolean }) {
  const [form, setForm] = useState(EMPTY);
  const [fileName, setFileName] = useState("");
  const [said, busy, handIn] = useHandIn(refresh);
  const set = (name: keyof typeof EMPTY) => (event: { currentTarget: { value: string } }) => setForm({ ...form, [name]: event.currentTarget.value });
  const open = work.orders.filter((o) => !o.complete);
  const take = (order: Order | undefined) => order && setForm({ ...form, pattern: order.design, test: order.test, batch: order.batch, orientation_deg: String(order.orientation_deg), strain_rate_per_s: String(order.strain_rate_per_s), thickness_mm: String(order.thickness_mm), specimen: `${order.batch || "hand"}-${order.design.slice(0, 6)}-${order.test[0]}${order.arrived + 1}` });
  const unit = form.test === "modulus" ? "GPa" : "MPa";
  const submit = async (event: Event) => {
    event.preventDefault();
    const { value, ...rest } = form;
    const measured = value.trim() === "" ? {} : form.test === "modulus" ? { modulus_pa: Number(value.replace(",", ".")) * 1e9 } : { toughness_pa: Number(value.replace(",", ".")) * 1e6 };
    if (await handIn("/api/measurement", { ...rest, ...measured }, `${form.specimen} is in the game.`)) {
      setForm({ ...EMPTY, test: form.test, pattern: form.pattern, batch: form.batch });
      setFileName("");
    }
  };
  return (
    <section class="panel">
      <h2>Enter a measurement</h2>
      {!playing ? <p class="awaited">Only while the game plays: the validation agent takes measurements.</p> : (
        <form onSubmit={submit} class="entry">
          {open.length > 0 && (
            <label class="whole">From an open order
              <select onChange={(e) => take(open.find((o) => o.order === e.currentTarget.value))}>
                <option value="">choose, or fill in by hand</option>
                {open.map((o) => <option key={o.order} value={o.order}>{o.design.slice(0, 16)} · {o.test}{o.orientation_deg ? " turned" : ""} · {o.arrived} of {o.replicates} here</option>)}
              </select>
            </label>
          )}
          <label>Specimen <input required name="specimen" maxLength={100} value={form.specimen} onInput={set("specimen")} placeholder="a name of its own" /></label>
          <label>Pattern <input required name="pattern" maxLength={101} spellcheck={false} value={form.pattern} onInput={set("pattern")} placeholder="key, rigid, soft, mix:0.65" /></label>
          <label>Test
            <select name="test" value={form.test} onChange={set("test")}><option>toughness</option><option>modulus</option><option>tensile</option></select>
          </label>
          <label>{form.test === "modulus" ? "Young's modulus" : "Toughness"} / {unit} <input name="value" inputMode="decimal" value={form.value} onInput={set("value")} placeholder="or from the curve" /></label>
          <label>Batch <input value={form.batch} maxLength={60} onInput={set("batch")} /></label>
          <label>Orientation <select value={form.orientation_deg} onChange={set("orientation_deg")}><option value="0">upright</option><option value="90">turned by 90°</option></select></label>
          <label>Thickness / mm <input inputMode="decimal" value={form.thickness_mm} onInput={set("thickness_mm")} placeholder="3.2" /></label>
          <label>Strain rate / s⁻¹ <input inputMode="decimal" value={form.strain_rate_per_s} onInput={set("strain_rate_per_s")} placeholder="6.17e-4" /></label>
          <label class="whole">Curve <input type="file" accept=".csv,text/csv" onChange={async (e) => { const file = e.currentTarget.files?.[0]; setFileName(file?.name ?? ""); setForm({ ...form, curve_csv: file ? await file.text() : "" }); }} />
            <span class="quiet">{fileName ? `${fileName}, ${form.curve_csv.split("\n").length - 1} rows` : "CSV with the columns strain,stress_pa"}</span></label>
          <label class="whole">Note <input value={form.note} maxLength={300} onInput={set("note")} /></label>
          <label class="check whole"><input type="checkbox" checked={form.valid} onChange={(e) => setForm({ ...form, valid: e.currentTarget.checked })} /> valid</label>
          <div class="whole"><button type="submit" disabled={busy}>Hand in</button></div>
        </form>
      )}
      <Notice said={said} />
    </section>
  );
}

function Specimens({ work, by, refresh, playing }: { work: Work; by: string; refresh: () => Promise<void>; playing: boolean }) {
  const [judged, setJudged] = useState<string | null>(null);
  const [why, setWhy] = useState("");
  const [find, setFind] = useState("");
  const [said, busy, handIn] = useHandIn(refresh);
  const doubts = new Map(work.groups.flatMap((g) => g.proposed_outliers.map((o) => [o.specimen, o.reasons] as const)));
  const rows = work.specimens.filter((s) => !find || `${s.specimen} ${s.design} ${s.test} ${s.batch}`.includes(find)).sort((a, b) => Number(doubts.has(b.specimen)) - Number(doubts.has(a.specimen)));
  const judge = async (s: LaboratorySpecimen) => {
    if (await handIn("/api/review", { specimen: s.specimen, valid: !s.valid, by, why }, `${s.specimen} is ${s.valid ? "not valid" : "valid"} now.`)) {
      setJudged(null);
      setWhy("");
    }
  };
  return (
    <section class="panel">
      <h2>Review</h2>
      <div class="row"><label>Find <input type="search" value={find} onInput={(e) => setFind(e.currentTarget.value)} placeholder="specimen, design, test or batch" /></label></div>
      <Notice said={said} />
      <Table name="specimens" caption={`Specimens (${work.specimens.length})`} rows={rows} rowKey={(s) => s.specimen} empty="Nothing has been measured yet." rowClass={(s) => (s.valid ? "" : "invalid")}
        columns={[
          { heading: "specimen", words: true, show: (s) => s.specimen, value: (s) => s.specimen },
          { heading: "design", words: true, show: (s) => <span class="with-unit"><Unit design={s.design} size={22} label={false} /><Name design={s.design} /></span>, value: (s) => s.design },
          { heading: "test", words: true, show: (s) => `${s.test}${s.orientation_deg ? ", turned" : ""}`, value: (s) => s.test },
          { heading: "E / GPa", show: (s) => gpa(s.modulus_pa), value: (s) => s.modulus_pa },
          { heading: "T / MPa", show: (s) => mpa(s.toughness_pa), value: (s) => s.toughness_pa },
          { heading: "valid", words: true, show: (s) => <span class={`chip ${s.valid ? "approved" : "rejected"}`}>{s.valid ? "valid" : "not valid"}</span>, value: (s) => s.valid },
          { heading: "remarks", words: true, show: (s) => <>{doubts.get(s.specimen)?.map((r) => <span key={r} class="doubt">{r}</span>)} <span class="quiet">{s.note}</span></>, value: (s) => s.note },
          {
            heading: "judge", words: true,
            show: (s) => !playing ? "" : judged === s.specimen ? (
              <form class="judge" onSubmit={(e) => { e.preventDefault(); void judge(s); }}>
                <input required autofocus aria-label={`why ${s.specimen} is ${s.valid ? "not valid" : "valid"}`} placeholder="why" value={why} maxLength={200} onInput={(e) => setWhy(e.currentTarget.value)} />
                <button type="submit" disabled={busy || !by}>{s.valid ? "not valid" : "valid"}</button>
                <button type="button" class="quiet" onClick={() => setJudged(null)}>cancel</button>
              </form>
            ) : <button type="button" class="quiet" onClick={() => { setJudged(s.specimen); setWhy(doubts.get(s.specimen)?.[0]?.slice(0, 200) ?? ""); }} aria-label={`judge ${s.specimen}`}>judge</button>,
          },
        ]} />
    </section>
  );
}

const stateColumns = [
  { heading: "design", words: true, show: (d: DesignState) => <span class="with-unit"><Unit design={d.design} size={22} label={false} /><Name design={d.design} /></span>, value: (d: DesignState) => d.design },
  { heading: "state", words: true, show: (d: DesignState) => <span class={`chip ${d.state}`}>{d.state}</span>, value: (d: DesignState) => d.state },
  { heading: "proposed", show: (d: DesignState) => d.proposed_in_round ?? "–", value: (d: DesignState) => d.proposed_in_round },
  { heading: "ordered", show: (d: DesignState) => d.ordered, value: (d: DesignState) => d.ordered },
  { heading: "printed", show: (d: DesignState) => d.printed, value: (d: DesignState) => d.printed },
  { heading: "measured", show: (d: DesignState) => d.measured, value: (d: DesignState) => d.measured },
  { heading: "valid", show: (d: DesignState) => d.valid, value: (d: DesignState) => d.valid },
  { heading: "decision", words: true, show: (d: DesignState) => (d.by ? `${d.by}: ${d.why}` : ""), value: (d: DesignState) => d.why },
];

const groupColumns = [
  { heading: "design", words: true, show: (g: Group) => <span class="with-unit"><Unit design={g.design} size={22} label={false} /><Name design={g.design} /></span>, value: (g: Group) => g.design },
  { heading: "test", words: true, show: (g: Group) => `${g.test}${g.orientation_deg ? ", turned" : ""}`, value: (g: Group) => g.test },
  { heading: "state", words: true, show: (g: Group) => <span class={`chip ${g.state === "complete" ? "approved" : g.state === "inconsistent" ? "rejected" : "pending"}`}>{g.state.replace("_", " ")}</span>, value: (g: Group) => g.state },
  { heading: "valid of tested", show: (g: Group) => `${g.valid.length} of ${g.tested.length}`, value: (g: Group) => g.valid.length },
  { heading: "mean", show: (g: Group) => (g.test === "modulus" ? `${gpa(g.mean_pa)} GPa` : `${mpa(g.mean_pa)} MPa`), value: (g: Group) => g.mean_pa },
  { heading: "scatter", show: (g: Group) => percent(g.scatter), value: (g: Group) => g.scatter },
];

export function Laboratory({ info, playing }: { info: RunInfo; playing: boolean }) {
  const [work, setWork] = useState<Work | null>(null);
  const [by, setBy] = useStored("by", info.user);
  const refresh = async () => {
    const next = await get<Work>("/api/laboratory");
    setWork((before) => (JSON.stringify(before) === JSON.stringify(next) ? before : next));
  };
  useRepeated(refresh, playing ? 2000 : 30_000);
  if (!work) return <p class="awaited wait">reading the laboratory's book …</p>;
  return (
    <>
      {playing && <div class="row who"><label>You are <input value={by} maxLength={60} onInput={(e) => setBy(e.currentTarget.value)} /></label><span class="quiet">kept with everything you decide here</span></div>}
      <Proposals work={work} by={by} refresh={refresh} playing={playing} approval={info.approval} />
      <Entry work={work} refresh={refresh} playing={playing} />
      <Specimens work={work} by={by} refresh={refresh} playing={playing} />
      <section class="panel"><Table name="replicates" caption="Replicates" rows={work.groups} rowKey={(g) => `${g.design}${g.test}${g.orientation_deg}`} empty="Nothing has been measured yet." columns={groupColumns} /></section>
      <section class="panel"><Table name="designs" caption="Designs" rows={work.designs} rowKey={(d) => d.design} empty="There is no design yet." columns={stateColumns} /></section>
    </>
  );
}

// From orders to the printer: jobs are made of what is ordered, saved as a ZIP, and marked as printed tray by tray.

import { useState } from "preact/hooks";
import { address, ofRun, type Laboratory, type PrintJob, type PrintJobs as Jobs, type PrintTray } from "./api";
import { counted } from "./numbers";
import { Notice, Problem, useRepeated } from "./parts";
import { useReading } from "./reading";
import { useSubmit } from "./submit";

/** What is asked for, as it is typed. */
interface Wish {
  printer: string;
  x: string;
  y: string;
  trays: boolean;
}

function JobForm({ jobs, busy, make }: { jobs: Jobs; busy: boolean; make: (wish: Wish) => void }) {
  const [wish, setWish] = useState<Wish>({ printer: jobs.printers[0].name, x: "", y: "", trays: true });
  const printer = jobs.printers.find((p) => p.name === wish.printer)!;
  const side = (name: "x" | "y", usual: number) => (
    <input
      type="number"
      min={10}
      max={10000}
      step="any"
      size={5}
      aria-label={`tray in ${name}, mm`}
      placeholder={String(usual)}
      value={wish[name]}
      onInput={(e) => setWish({ ...wish, [name]: e.currentTarget.value })}
    />
  );
  return (
    <form
      class="row"
      onSubmit={(e) => {
        e.preventDefault();
        make(wish);
      }}
    >
      <label>
        Printer{" "}
        <select
          value={wish.printer}
          onChange={(e) => setWish({ ...wish, printer: e.currentTarget.value, x: "", y: "" })}
        >
          {jobs.printers.map((p) => (
            <option key={p.name} value={p.name}>
              {p.name}
            </option>
          ))}
        </select>
      </label>
      <span>
        Tray {side("x", printer.tray_x_mm)} x {side("y", printer.tray_y_mm)} mm
      </span>
      <label class="check">
        <input
          type="checkbox"
          checked={wish.trays}
          onChange={(e) => setWish({ ...wish, trays: e.currentTarget.checked })}
        />{" "}
        also a stack for each whole tray
      </label>
      <button type="submit" disabled={busy}>
        Make a print job of {counted(jobs.unprinted, "specimen")}
      </button>
      <span class="quiet">{printer.words}</span>
    </form>
  );
}

/** How far a tray has got: by its labels. */
function stateOf(tray: PrintTray, printed: Set<string>, measured: Set<string>) {
  const isMeasured = tray.labels.some((label) => measured.has(label));
  return { isMeasured, isPrinted: isMeasured || tray.labels.every((label) => printed.has(label)) };
}

export function PrintJobs({
  laboratory,
  by,
  refresh,
}: {
  laboratory: Laboratory;
  by: string;
  refresh: () => Promise<void>;
}) {
  const version = JSON.stringify([laboratory.orders, laboratory.printed, laboratory.specimens.length]);
  const { value: jobs, problem, read } = useReading<Jobs>("/api/jobs", {}, version);
  const both = async () => {
    await read();
    await refresh();
  };
  const [notice, busy, submit] = useSubmit(both, "writing …");
  const [isDiscarding, setDiscarding] = useState("");
  const isMaking = jobs?.jobs.some((job) => job.state === "queued" || job.state === "working") ?? false;
  useRepeated(read, 500, isMaking);
  const printed = new Set(laboratory.printed.map((p) => p.label));
  const measured = new Set(laboratory.specimens.map((s) => s.specimen));
  if (!jobs) return <Problem text={problem} />;
  const make = (wish: Wish) => {
    const printer = jobs.printers.find((p) => p.name === wish.printer)!;
    const tray_mm = [Number(wish.x) || printer.tray_x_mm, Number(wish.y) || printer.tray_y_mm];
    const body = { printer: wish.printer, tray_stacks: wish.trays, tray_mm };
    void submit("/api/job", body, "Its trays stand here once it is made.");
  };
  const mark = (job: PrintJob, tray: PrintTray, isPrinted: boolean) =>
    submit(
      "/api/printed",
      { job: job.job, tray: tray.tray, printed: isPrinted, by },
      `Tray ${tray.tray} of ${job.job} is ${isPrinted ? "printed" : "not printed"}.`,
    );
  const discard = (job: string) => submit("/api/discard", { job }, `${job} is discarded.`);
  if (jobs.unprinted === 0 && jobs.jobs.length === 0) return null;
  return (
    <section class="panel print-jobs">
      <h2>Print</h2>
      {jobs.unprinted > 0 && <JobForm jobs={jobs} busy={busy || isMaking} make={make} />}
      <ul class="cards" aria-label="print jobs">
        {jobs.jobs.map((job) => {
          const states = job.trays.map((tray) => stateOf(tray, printed, measured));
          return (
            <li key={job.job} class="card job">
              <div>
                <h3>{job.job}</h3>
                <p class="quiet">
                  {[job.price, job.printer].filter(Boolean).join("; ")}
                </p>
                {job.state === "failed" && <p class="fault">{job.problem}</p>}
                {(job.state === "queued" || job.state === "working") && (
                  <progress aria-label={`${job.job} is being made`} value={job.progress} />
                )}
                {job.has_files && (
                  <a class="button" href={ofRun(address("/api/job", { job: job.job }))} download>
                    Save the job as ZIP
                  </a>
                )}
                {job.state === "ready" && !states.some((s) => s.isPrinted) && (
                  <button
                    type="button"
                    class="quiet"
                    onClick={() => {
                      if (isDiscarding === job.job) void discard(job.job);
                      setDiscarding(isDiscarding === job.job ? "" : job.job);
                    }}
                    onBlur={() => setDiscarding("")}
                  >
                    {isDiscarding === job.job ? "discard its files" : "discard …"}
                  </button>
                )}
                <ul class="trays" aria-label={`trays of ${job.job}`}>
                  {job.trays.map((tray, i) => (
                    <li key={tray.tray}>
                      {job.has_files && (
                        <a
                          href={ofRun(address("/api/tray", { job: job.job, tray: tray.tray }))}
                          target="_blank"
                          rel="noopener"
                        >
                          <img
                            src={ofRun(address("/api/tray", { job: job.job, tray: tray.tray }))}
                            alt={`tray ${tray.tray} of ${job.job}: ${tray.labels.join(", ")}`}
                            loading="lazy"
                          />
                        </a>
                      )}
                      <p>
                        Tray {tray.tray}, {counted(tray.labels.length, "specimen")}{" "}
                        {states[i].isPrinted && <span class="chip approved">printed</span>}
                      </p>
                      {!states[i].isPrinted && (
                        <button type="button" disabled={busy || !by} onClick={() => mark(job, tray, true)}>
                          It is printed
                        </button>
                      )}
                      {states[i].isPrinted && !states[i].isMeasured && (
                        <button
                          type="button"
                          class="quiet"
                          disabled={busy || !by}
                          onClick={() => mark(job, tray, false)}
                        >
                          undo
                        </button>
                      )}
                    </li>
                  ))}
                </ul>
              </div>
            </li>
          );
        })}
      </ul>
      <Problem text={problem} />
      <Notice notice={notice} />
    </section>
  );
}

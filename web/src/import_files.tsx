// The files of the testing machine: dropped, understood, asked about, corrected in place, handed in.

import { useRef, useState } from "preact/hooks";
import type { Laboratory } from "./api";
import { overview, testsIn, useImport, type Question } from "./import_draft";
import { ImportTable } from "./import_table";
import { Notice } from "./parts";

/** Columns of the sheet that a question may be about. */
const SETTABLE = {
  unit: "units of columns without one",
  pattern: "pattern",
  test: "test",
  width_mm: "width / mm",
  thickness_mm: "thickness / mm",
  gauge_mm: "gauge / mm",
  extension_column: "heading of the extension",
  force_column: "heading of the force",
  time_column: "heading of the time",
  part: "part of the file",
};

const listed = (specimens: string[]) =>
  specimens.length <= 4 ? specimens.join(", ") : `${specimens.slice(0, 3).join(", ")} and ${specimens.length - 3} more`;

function AskedOnce({
  question,
  settle,
  split,
  edit,
}: {
  question: Question;
  settle: () => void;
  split: () => void;
  edit: (column: string, text: string) => void;
}) {
  const named = question.column in SETTABLE ? (question.column as keyof typeof SETTABLE) : "unit";
  const [column, setColumn] = useState<keyof typeof SETTABLE>(named);
  const [text, setText] = useState("");
  return (
    <li class="card question">
      <div>
        <p class={question.isDoubt ? "doubt" : "fault"}>{question.text}</p>
        <p class="quiet">{listed(question.specimens)}</p>
        <form
          class="row"
          onSubmit={(event) => {
            event.preventDefault();
            edit(column, text);
          }}
        >
          {question.isDoubt && (
            <button type="button" onClick={settle}>
              It is right
            </button>
          )}
          {testsIn(question) > 1 && (
            <button type="button" onClick={split}>
              A row for each of the {testsIn(question)} tests
            </button>
          )}
          <select
            aria-label="column to correct"
            value={column}
            onChange={(e) => setColumn(e.currentTarget.value as keyof typeof SETTABLE)}
          >
            {Object.entries(SETTABLE).map(([name, label]) => (
              <option key={name} value={name}>
                {label}
              </option>
            ))}
          </select>
          <input
            required
            aria-label="what stands there"
            value={text}
            maxLength={100}
            placeholder={column === "unit" ? "mm N s" : ""}
            onInput={(e) => setText(e.currentTarget.value)}
          />
          <button type="submit" class="quiet">
            correct {question.specimens.length === 1 ? "it" : `all ${question.specimens.length}`}
          </button>
        </form>
      </div>
    </li>
  );
}

export function ImportFiles({
  laboratory,
  refresh,
  playing,
}: {
  laboratory: Laboratory;
  refresh: () => Promise<void>;
  playing: boolean;
}) {
  const { draft, understood, notice, busy, take, edit, split, settle, leaveOut, keepToe, forget, handIn } = useImport(
    laboratory,
    refresh,
  );
  const [isOver, setOver] = useState(false);
  const [isDiscarding, setDiscarding] = useState(false);
  const chooser = useRef<HTMLInputElement>(null);
  const { rows, questions } = overview(draft, understood);
  const ready = rows.filter((r) => r.understood.length > 0 && !r.isLeftOut && !r.isOpen);
  const unread = rows.filter((r) => r.understood.length === 0 && !r.isLeftOut).length;
  const isEmpty = draft.exports.length === 0 && !draft.sheet;
  return (
    <section
      class={`panel import${isOver ? " over" : ""}`}
      onDragOver={(event) => {
        event.preventDefault();
        setOver(true);
      }}
      onDragLeave={() => setOver(false)}
      onDrop={(event) => {
        event.preventDefault();
        setOver(false);
        void take([...(event.dataTransfer?.files ?? [])]);
      }}
    >
      <h2>Files of the testing machine</h2>
      <div class="row drop">
        <span>
          Drop the specimens' sheet and the machine's exports here, or{" "}
          <button type="button" onClick={() => chooser.current?.click()}>
            choose files
          </button>
        </span>
        <input
          ref={chooser}
          type="file"
          multiple
          hidden
          aria-label="files of the testing machine"
          onChange={(event) => {
            void take([...(event.currentTarget.files ?? [])]);
            event.currentTarget.value = "";
          }}
        />
        <span class="quiet">
          {isEmpty
            ? "Without a sheet the page makes one from the open orders."
            : `${draft.exports.length} exports, ${draft.sheet?.name ?? "no sheet yet"}; kept in this browser`}
        </span>
        {!isEmpty && (
          <label class="check" title="Else a curve begins where its straight part meets zero force (ASTM D638 A1).">
            <input type="checkbox" checked={draft.keepsToe} onChange={(e) => keepToe(e.currentTarget.checked)} /> keep
            the flat beginning of curves
          </label>
        )}
        {!isEmpty && (
          <button
            type="button"
            class="quiet"
            onClick={() => {
              if (isDiscarding) forget();
              setDiscarding(!isDiscarding);
            }}
            onBlur={() => setDiscarding(false)}
          >
            {isDiscarding ? "discard all of it" : "discard …"}
          </button>
        )}
      </div>
      {questions.length > 0 && (
        <ul class="cards" aria-label="questions before specimens count">
          {questions.map((question) => (
            <AskedOnce
              key={question.key}
              question={question}
              settle={() => settle(question)}
              split={() => split(question)}
              edit={(column, text) => edit(question.rows, column, text)}
            />
          ))}
        </ul>
      )}
      {rows.length > 0 && understood && (
        <ImportTable sheet={draft.sheet!} rows={rows} laboratory={laboratory} edit={edit} leaveOut={leaveOut} />
      )}
      {(understood?.warnings ?? [])
        .filter((warning) => !/^specimens? /.test(warning))
        .map((warning) => (
          <p key={warning} class="quiet">
            {warning}
          </p>
        ))}
      {rows.length > 0 && understood && (
        <div class="row">
          <button type="button" disabled={busy || !playing || ready.length === 0} onClick={() => void handIn(ready)}>
            Hand in {ready.length === 1 ? "1 specimen" : `${ready.length} specimens`}
          </button>
          <span class="quiet">
            {!playing && "Measurements can be handed in while the game is running. "}
            {unread > 0 && `${unread} cannot be read yet. `}
            {questions.some((q) => q.isDoubt) && "Others wait for an answer above."}
          </span>
        </div>
      )}
      <Notice notice={notice} />
    </section>
  );
}

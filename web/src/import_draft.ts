// Files of the testing machine on their way into the run: kept in the browser, read by the server, handed in.

import { useEffect, useRef, useState } from "preact/hooks";
import type { ImportFault, Laboratory, Understood, UnderstoodSpecimen } from "./api";
import { postFiles, problemOf } from "./api";
import { keepDraft, keepTyping, keptDraft, keptTyping } from "./kept_draft";
import type { NoticeText } from "./parts";
import { cell, decoded, lineOf, sheetIn, sheetOfOrders, textOf, withCells, withParts, type Sheet } from "./sheet";

export interface Draft {
  exports: File[];
  sheet: Sheet | null;
  /** Nobody dropped the sheet: the page makes its rows from the open orders. */
  isBuilt: boolean;
  /** Specimens of a sheet that the page built whose order only the place among the files told. */
  guessed: string[];
  /** Questions that are answered: specimen and question. */
  settled: string[];
  leftOut: string[];
  /** The flat beginning of curves is kept (`nacre import --toe keep`). */
  keepsToe: boolean;
}

/** What of a draft is no file. */
type Typed = Omit<Draft, "exports">;

const EMPTY: Draft = {
  exports: [], sheet: null, isBuilt: false, guessed: [], settled: [], leftOut: [], keepsToe: false,
};

/** Something that a person decides before specimens count, asked once for all whom it concerns. */
export interface Question {
  key: string;
  text: string;
  rows: number[];
  specimens: string[];
  /** It can be answered with yes; a fault cannot. */
  isDoubt: boolean;
  /** Column of the sheet that it is about; empty: of none. */
  column: string;
}

/** A row of the sheet and what is understood of it. */
export interface Row {
  index: number;
  specimen: string;
  understood: UnderstoodSpecimen[];
  fault: ImportFault | null;
  answer: { answer: string; error?: string } | null;
  isLeftOut: boolean;
  isOpen: boolean;
}

const GUESS = "The page took this order because it was the next one that is open: does the file belong to it?";

/** The same doubt about another specimen has other numbers in it. */
const kindOf = (text: string) => text.replace(/[-+]?\d[\d.,e+-]*/g, "#");
const aboutNobody = (text: string, specimen: string) => text.replaceAll(`specimen ${specimen}: `, "");
const answered = (specimen: string, key: string) => `${specimen}\n${key}`;

/** `file, line N, column: reason` */
export const inWords = ({ file, line, column, reason }: ImportFault) =>
  `${[file, line > 0 ? `line ${line}` : "", column].filter(Boolean).join(", ")}: ${reason}`;

/** What is asked about a specimen. */
function doubtsOf(draft: Draft, one: UnderstoodSpecimen): string[] {
  const doubts = one.doubts.filter((d) => d.of_scale).map((d) => aboutNobody(d.text, one.specimen));
  return draft.guessed.includes(one.specimen) ? [...doubts, GUESS] : doubts;
}

/** The rows of a sheet and the questions that are open. */
export function overview(draft: Draft, understood: Understood | null): { rows: Row[]; questions: Question[] } {
  const questions = new Map<string, Question>();
  type Asked = Pick<Question, "text" | "isDoubt" | "column">;
  const ask = (key: string, asked: Asked, index: number, specimen: string) => {
    const question = questions.get(key) ?? { ...asked, key, rows: [], specimens: [] };
    question.rows.push(index);
    question.specimens.push(specimen);
    questions.set(key, question);
  };
  const rows = (draft.sheet?.rows ?? []).map((_, index) => {
    const specimen = cell(draft.sheet!, index, "specimen");
    const own = (understood?.specimens ?? []).filter((s) => s.line === lineOf(index));
    const isOwn = (f: ImportFault) =>
      f.specimen ? f.specimen === specimen : f.file === draft.sheet!.name && f.line === lineOf(index);
    const fault = (own.length === 0 && understood?.rejected.find(isOwn)) || null;
    const isLeftOut = draft.leftOut.includes(specimen);
    let isOpen = false;
    for (const one of isLeftOut ? [] : own)
      for (const text of doubtsOf(draft, one)) {
        if (draft.settled.includes(answered(one.specimen, kindOf(text)))) continue;
        isOpen = true;
        ask(kindOf(text), { text, isDoubt: true, column: "" }, index, one.specimen);
      }
    if (fault && !isLeftOut)
      ask(
        fault.column === "part" ? fault.reason : kindOf(fault.reason), // how many tests a file holds matters
        { text: inWords(fault), isDoubt: false, column: fault.column },
        index,
        specimen,
      );
    const answer = understood?.answers?.find((a) => own.some((one) => one.specimen === a.specimen)) ?? null;
    return { index, specimen, understood: own, fault, answer, isLeftOut, isOpen };
  });
  return { rows, questions: [...questions.values()] };
}

/** How many tests the file of a question holds; 0: the question is another. */
export const testsIn = ({ text, column }: Question) =>
  column === "part" ? Number(/holds (\d+) tests/.exec(text)?.[1] ?? 0) : 0;

const isTaken = (answer: string) => answer === "accepted" || answer === "repeated";

interface Entered {
  enter: string[];
  confirmed: string[];
}

/** The files as a form: with what is to be entered, where anything is. */
function formOf(draft: Draft, entered: Entered | null): FormData {
  const form = new FormData();
  form.append("sheet", new Blob([textOf(draft.sheet!)]), draft.sheet!.name);
  for (const file of draft.exports) form.append("export", file, file.name);
  form.append("choice", JSON.stringify({ ...entered, toe: draft.keepsToe ? "keep" : "compensate" }));
  return form;
}

/** A draft with further files: a sheet replaces the one before, an export one of its name. */
async function withFiles(draft: Draft, files: File[], laboratory: Laboratory): Promise<Draft> {
  const LARGEST_SHEET = 4 << 20;
  let { sheet, isBuilt, guessed } = draft;
  const exports = new Map(draft.exports.map((file) => [file.name, file]));
  for (const file of files) {
    const found = file.size <= LARGEST_SHEET ? sheetIn(file.name, decoded(await file.arrayBuffer())) : null;
    if (found) [sheet, isBuilt, guessed] = [found, false, []];
    else exports.set(file.name, file);
  }
  if ((!sheet || isBuilt) && exports.size > 0) {
    const built = sheetOfOrders([...exports.keys()], laboratory, sheet);
    [sheet, isBuilt, guessed] = [built.sheet, true, [...guessed, ...built.guessed]];
  }
  return { ...draft, exports: [...exports.values()], sheet, isBuilt, guessed };
}

const PAUSE_MS = 500; // after a key, before the files are read again

export function useImport(laboratory: Laboratory, refresh: () => Promise<void>) {
  const [draft, setDraft] = useState<Draft>(EMPTY);
  const [understood, setUnderstood] = useState<Understood | null>(null);
  const [notice, setNotice] = useState<NoticeText | null>(null);
  const [busy, setBusy] = useState(false);
  const asked = useRef<AbortController | null>(null);
  const timer = useRef(0);

  /** Sends the files; the newest request alone counts. */
  const send = async (now: Draft, choice: Entered | null) => {
    asked.current?.abort();
    const own = (asked.current = new AbortController());
    setBusy(true);
    setNotice({ kind: "busy", text: choice ? "waiting for the validation agent …" : "reading the files …" });
    try {
      const response = await postFiles<Understood>("/api/import", formOf(now, choice), own.signal);
      if (asked.current !== own) return null;
      setUnderstood(response);
      setNotice(null);
      return response;
    } catch (error) {
      if (asked.current === own) setNotice({ kind: "bad", text: problemOf(error) });
      return null;
    } finally {
      if (asked.current === own) setBusy(false);
    }
  };
  const readAgain = (now: Draft, pause_ms = 0) => {
    clearTimeout(timer.current);
    if (now.sheet && now.exports.length > 0) timer.current = window.setTimeout(() => void send(now, null), pause_ms);
  };
  const change = (next: Draft) => {
    setDraft(next);
    const isEmpty = next.exports.length === 0 && !next.sheet;
    const { exports, ...typed } = next;
    keepTyping("import", isEmpty ? undefined : typed);
    const kept = [keepDraft("import", isEmpty ? undefined : typed)];
    // Files are written once: a reload while they are written again would cost them.
    if (exports !== draft.exports) kept.push(keepDraft("import/files", isEmpty ? undefined : exports));
    Promise.all(kept).catch(() =>
      setNotice({ kind: "bad", text: "This browser keeps no drafts: a reload would lose these files." }),
    );
  };
  useEffect(() => {
    void Promise.all([keptDraft<Typed>("import"), keptDraft<File[]>("import/files")])
      .catch(() => [undefined, undefined] as const)
      .then(([kept, exports]) => {
        const typed = keptTyping<Typed>("import") ?? kept;
        if (!typed) return;
        const now = { ...EMPTY, ...typed, exports: exports ?? [] };
        setDraft(now);
        readAgain(now);
      });
    return () => {
      clearTimeout(timer.current);
      asked.current?.abort();
    };
  }, []);

  const take = async (files: File[]) => {
    if (files.length === 0) return;
    const next = await withFiles(draft, files, laboratory);
    change(next);
    if (next.exports.length === 0)
      setNotice({ kind: "good", text: `${next.sheet!.name} is the sheet: add the files that it names.` });
    readAgain(next);
  };
  const edit = (rows: number[], column: string, text: string) => {
    if (!draft.sheet) return;
    const lines = rows.map(lineOf);
    const names = (understood?.specimens ?? []).filter((s) => lines.includes(s.line)).map((s) => s.specimen);
    const isAbout = (entry: string) => names.some((name) => entry.startsWith(`${name}\n`));
    const isAssigned = column === "specimen" || column === "pattern"; // by the person, not by a guess
    const next = {
      ...draft,
      sheet: withCells(draft.sheet, rows, column, text),
      guessed: isAssigned ? draft.guessed.filter((name) => !names.includes(name)) : draft.guessed,
      settled: draft.settled.filter((entry) => entry.endsWith(GUESS) || !isAbout(entry)), // of other cells
    };
    change(next);
    readAgain(next, PAUSE_MS);
  };
  /** Rows for the tests of one file each: its specimens are named by their number in it. */
  const split = (question: Question) => {
    if (!draft.sheet) return;
    const fromLast = [...question.rows].sort((a, b) => b - a);
    const sheet = fromLast.reduce((now, row) => withParts(now, row, testsIn(question)), draft.sheet);
    const next = { ...draft, sheet };
    change(next);
    readAgain(next);
  };
  const settle = ({ key, specimens }: Question) =>
    change({ ...draft, settled: [...draft.settled, ...specimens.map((name) => answered(name, key))] });
  const leaveOut = (specimen: string, out: boolean) =>
    change({ ...draft, leftOut: out ? [...draft.leftOut, specimen] : draft.leftOut.filter((s) => s !== specimen) });
  const keepToe = (keepsToe: boolean) => {
    const next = { ...draft, keepsToe };
    change(next);
    readAgain(next);
  };
  const forget = () => {
    asked.current?.abort();
    clearTimeout(timer.current);
    setUnderstood(null);
    setNotice(null);
    setBusy(false);
    change(EMPTY);
  };
  /** Hands in; once all of the sheet is in the run, the draft has done its work. */
  const handIn = async (rows: Row[]) => {
    const wanted = rows.flatMap((row) => row.understood);
    const confirmed = wanted.filter((one) => doubtsOf(draft, one).length > 0); // each of them is answered
    const names = (list: UnderstoodSpecimen[]) => list.map((one) => one.specimen);
    const response = await send(draft, { enter: names(wanted), confirmed: names(confirmed) });
    await refresh();
    const answers = response?.answers ?? [];
    const failed = answers.filter(({ answer }) => !isTaken(answer));
    if (answers.length === 0) return;
    const taken = answers.length - failed.length;
    const all = failed.length === 0 && rows.length === draft.sheet?.rows.length;
    if (all) forget();
    const done = `${taken === 1 ? "1 specimen is" : `${taken} specimens are`} in the run.`;
    const why = failed.length > 0 ? ` ${failed.length} not: ${failed[0].error || failed[0].answer}` : "";
    setNotice({ kind: failed.length > 0 ? "bad" : "good", text: done + why });
  };
  return { draft, understood, notice, busy, take, edit, split, settle, leaveOut, keepToe, forget, handIn };
}

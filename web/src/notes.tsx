// Notes and photos of a specimen, a design or a round, kept in the run's folder.

import { useState } from "preact/hooks";
import { address, ofRun, type Note, type Notes as NotesRead } from "./api";
import { Notice, Problem, useStored } from "./parts";
import { useReading } from "./reading";
import { useOpenRun } from "./run_context";
import { useSubmit } from "./submit";

export type Subject = Pick<Note, "name"> & { about: "specimen" | "design" | "round" };

const MOST_SIDE = 2000; // points: a crack is seen, and the photo fits a request

/** A photo as JPEG in base64, made smaller where it is large; what the camera writes beside it (place, time) is left
 *  out. */
async function photoIn(file: File): Promise<string> {
  const bitmap = await createImageBitmap(file);
  const scale = Math.min(1, MOST_SIDE / Math.max(bitmap.width, bitmap.height));
  const canvas = new OffscreenCanvas(Math.round(bitmap.width * scale), Math.round(bitmap.height * scale));
  canvas.getContext("2d")!.drawImage(bitmap, 0, 0, canvas.width, canvas.height);
  const jpeg = await canvas.convertToBlob({ type: "image/jpeg", quality: 0.85 });
  const bytes = new Uint8Array(await jpeg.arrayBuffer());
  let letters = "";
  for (let i = 0; i < bytes.length; i += 0x8000) letters += String.fromCharCode(...bytes.subarray(i, i + 0x8000));
  return btoa(letters);
}

function NoteItem({ note, remove }: { note: Note; remove: () => void }) {
  const [isSure, setSure] = useState(false);
  const photo = note.photo && ofRun(address("/api/photo", { file: note.photo }));
  return (
    <li>
      {photo && (
        <a href={photo} target="_blank" rel="noopener">
          <img src={photo} alt={note.text || `photo by ${note.by}`} loading="lazy" />
        </a>
      )}
      <p class="text">{note.text}</p>
      <p class="quiet">
        {note.by}, {note.when.replace("T", " ").replace("Z", " UTC")}{" "}
        <button
          type="button"
          class="quiet"
          onClick={() => (isSure ? remove() : setSure(true))}
          onBlur={() => setSure(false)}
        >
          {isSure ? "remove it for good" : "remove …"}
        </button>
      </p>
    </li>
  );
}

function NoteForm({ about, name, refresh }: Subject & { refresh: () => Promise<void> }) {
  const run = useOpenRun();
  const [by, setBy] = useStored("by", run?.user ?? "");
  const [text, setText] = useState("");
  const [photo, setPhoto] = useState<{ name: string; base64: string } | null>(null);
  const [fault, setFault] = useState("");
  const [notice, busy, submit] = useSubmit(refresh, "writing …");
  const take = async (file: File) => {
    setFault("");
    try {
      setPhoto({ name: file.name, base64: await photoIn(file) });
    } catch {
      setPhoto(null);
      setFault(`${file.name} is no picture that this browser reads.`);
    }
  };
  const keep = async () => {
    const body = { about, name, by, text: text.replaceAll("\r", ""), photo: photo?.base64 ?? null };
    if (!(await submit("/api/note", body, "Kept with the run."))) return;
    setText("");
    setPhoto(null);
  };
  return (
    <form
      class="note-form"
      onSubmit={(e) => {
        e.preventDefault();
        void keep();
      }}
    >
      <textarea
        rows={2}
        maxLength={3000}
        aria-label={`note on ${about} ${name}`}
        placeholder="what you saw"
        value={text}
        onInput={(e) => setText(e.currentTarget.value)}
      />
      <div class="row">
        <label class="file">
          Photo{" "}
          <input
            type="file"
            accept="image/*"
            onChange={(e) => {
              const [file] = e.currentTarget.files ?? [];
              e.currentTarget.value = "";
              if (file) void take(file);
            }}
          />
        </label>
        {photo && <span class="quiet">{photo.name} goes with it</span>}
        <label>
          You are <input required size={14} value={by} maxLength={60} onInput={(e) => setBy(e.currentTarget.value)} />
        </label>
        <button type="submit" disabled={busy || !by || (!text.trim() && !photo)}>
          Keep the note
        </button>
      </div>
      <Problem text={fault} />
      <Notice notice={notice} />
    </form>
  );
}

/** Notes on one subject, the oldest first, and a form for the next. */
export function Notes({ about, name }: Subject) {
  const { value, problem, read } = useReading<NotesRead>("/api/notes", {}, `${about} ${name}`);
  const [opened, setOpened] = useState<boolean | null>(null); // null: by nobody yet
  const [notice, , submit] = useSubmit(read, "removing …");
  const notes = (value?.notes ?? []).filter((note) => note.about === about && note.name === name);
  const isOpen = opened ?? notes.length > 0;
  return (
    <details class="notes" open={isOpen} onToggle={(e) => e.currentTarget.open !== isOpen && setOpened(!isOpen)}>
      <summary>Notes and photos{notes.length > 0 && ` (${notes.length})`}</summary>
      {isOpen && (
        <>
          <Problem text={problem} />
          <ul>
            {notes.map((note) => (
              <NoteItem
                key={note.id}
                note={note}
                remove={() => void submit("/api/note_removal", { id: note.id }, "The note is removed.")}
              />
            ))}
          </ul>
          <Notice notice={notice} />
          <NoteForm key={`${about} ${name}`} about={about} name={name} refresh={read} />
        </>
      )}
    </details>
  );
}

/** Notes on a round, the newest unless another one is picked. */
export function RoundNotes({ rounds }: { rounds: number[] }) {
  const [picked, setPicked] = useState<string | null>(null);
  const round = picked ?? String(rounds.at(-1) ?? 0);
  return (
    <div class="row round-notes">
      <label>
        round{" "}
        <select value={round} onChange={(e) => setPicked(e.currentTarget.value)}>
          {rounds.map((each) => (
            <option key={each} value={String(each)}>
              {each}
            </option>
          ))}
        </select>
      </label>
      <Notes key={round} about="round" name={round} />
    </div>
  );
}

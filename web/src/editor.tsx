// Drawing a pattern: what it violates and how stiff it is at once, how it breaks on request.

import { useEffect, useRef, useState } from "preact/hooks";
import { get, problemOf, type DesignCheck, type Rounds } from "./api";
import { DesignBody } from "./design_panel";
import { keyInFile, LayoutFault } from "./layout_file";
import { gpa, percent } from "./numbers";
import { MaterialKey, Notice, Nowhere, saveUnit, type NoticeText } from "./parts";
import { inverted, keyOfBits } from "./pattern";
import { PixelEditor } from "./pixel_editor";
import { addressOf, type Looking } from "./route";
import { newestModel } from "./rounds";

const WHOLLY_RIGID = keyOfBits((1n << 55n) - 1n);
const AGAIN_MS = 500;

const isPattern = (key: string) => /^[0-9a-f]{14}$/.test(key) && key <= WHOLLY_RIGID;

/** What the server says of a pattern; it is asked for one at a time, and for the newest when it has responded. */
function useCheck(design: string, model: string): { check: DesignCheck | null; problem: string } {
  const [said, setSaid] = useState<{ check: DesignCheck | null; problem: string }>({ check: null, problem: "" });
  const wanted = useRef({ design, model });
  const isAsking = useRef(false);
  wanted.current = { design, model };
  useEffect(() => {
    const ask = async () => {
      if (isAsking.current) return;
      isAsking.current = true;
      for (let asked = ""; asked !== JSON.stringify(wanted.current);) {
        asked = JSON.stringify(wanted.current);
        try {
          setSaid({ check: await get<DesignCheck>("/api/check", wanted.current), problem: "" });
        } catch (error) {
          setSaid((before) => ({ ...before, problem: problemOf(error) }));
          await new Promise((done) => setTimeout(done, AGAIN_MS));
        }
      }
      isAsking.current = false;
    };
    void ask();
  }, [design, model]);
  return said;
}

/** E and the constraints, of the pattern as it was when the server last responded. */
function Verdict({ check, isNow }: { check: DesignCheck | null; isNow: boolean }) {
  if (!check) return <p class="awaited">computing E …</p>;
  return (
    <div class={isNow ? "" : "quiet"} role="status">
      <p>
        E {check.modulus_pa === null ? `cannot be computed: ${check.problem}` : `${gpa(check.modulus_pa)} GPa`}, rigid
        share {percent(check.rigid_fraction)}
      </p>
      {check.violations.length === 0 ? (
        <p class="good">Within the design space: the game may propose such a pattern.</p>
      ) : (
        <ul class="violations">
          {check.violations.map((violation) => (
            <li key={violation} class="doubt">
              Outside the design space: {violation}.
            </li>
          ))}
          <li class="quiet">It can be simulated and measured all the same.</li>
        </ul>
      )}
    </div>
  );
}

/** The newest model, or that before anything was fitted. */
function modelIn(rounds: Rounds): string {
  const newest = newestModel(rounds);
  const isThere = rounds.rounds.some((r) => r.round === newest && Object.keys(r.parameters).length > 0);
  return isThere ? String(newest) : "start";
}

function Upload({ take }: { take: (design: string) => void }) {
  const [notice, setNotice] = useState<NoticeText | null>(null);
  const read = async (file: File) => {
    try {
      take(await keyInFile(file));
      setNotice({ kind: "good", text: `${file.name} is shown.` });
    } catch (error) {
      const why = error instanceof LayoutFault ? error.message : "It cannot be read.";
      setNotice({ kind: "bad", text: `${file.name}: ${why}` });
    }
  };
  return (
    <div>
      <label>
        From a file{" "}
        <input
          type="file"
          accept=".txt,text/plain,image/png,image/bmp,image/gif,image/webp"
          onChange={(e) => {
            const [file] = e.currentTarget.files ?? [];
            e.currentTarget.value = ""; // the same file may have been changed
            if (file) void read(file);
          }}
        />
      </label>
      <p class="quiet">
        A picture of 20 x 20 pixels at any size, light for rigid and dark for soft, or 20 lines of 0 (soft) and 1
        (rigid).
      </p>
      <Notice notice={notice} />
    </div>
  );
}

export function EditorView({ rounds, data, looking }: { rounds: Rounds; data: string | null; looking: Looking }) {
  const design = looking.at.design ?? WHOLLY_RIGID;
  if (!isPattern(design))
    return <Nowhere why={`“${design}” is no pattern with the eightfold symmetry.`} link={addressOf("editor")} />;
  return <Editor key={design} first={design} model={modelIn(rounds)} data={data} looking={looking} />;
}

function Editor(
  { first, model, data, looking }: { first: string; model: string; data: string | null; looking: Looking },
) {
  const [design, setDesign] = useState(first);
  const [past, setPast] = useState<string[]>([]);
  const [broken, setBroken] = useState<string | null>(null);
  const { check, problem } = useCheck(design, model);
  const isNow = check?.design === design;
  /** The address follows without a step in the browser's history: there is a button to undo. */
  const settle = (next: string) => {
    setDesign(next);
    history.replaceState(null, "", addressOf("editor", { design: next }));
  };
  const step = (before: string, next: string) => {
    if (next === before) return;
    setPast([...past, before]);
    settle(next);
  };
  return (
    <div class="split">
      <section class="panel">
        <div class="panel-head">
          <h2>Editor</h2>
          <MaterialKey />
        </div>
        <p class="quiet">
          Click or drag: a pixel changes with its seven mirror images, so that the pattern keeps its symmetry.
        </p>
        <div class="editor">
          <PixelEditor
            design={design}
            marked={isNow ? check.soft_corner : ""}
            draw={setDesign}
            done={step}
          />
          <div>
            <p class="keyline">
              <code class="key">{design}</code>
            </p>
            <Verdict check={check} isNow={isNow} />
            {problem && <p class="notice bad">{problem}</p>}
            <div class="buttons">
              <button type="button" onClick={() => setBroken(design)}>
                Break it: T and film
              </button>
              <button
                type="button"
                class="quiet"
                disabled={past.length === 0}
                onClick={() => {
                  settle(past.at(-1)!);
                  setPast(past.slice(0, -1));
                }}
              >
                undo
              </button>
              <button type="button" class="quiet" onClick={() => step(design, inverted(design))}>
                exchange materials
              </button>
              <button type="button" class="quiet" onClick={() => saveUnit(design)}>
                SVG
              </button>
            </div>
            <label class="row">
              Key{" "}
              <input
                size={16}
                maxLength={14}
                spellcheck={false}
                placeholder="14 hex digits"
                aria-label="key of a pattern to begin with"
                onChange={(e) => {
                  const key = e.currentTarget.value.trim();
                  if (isPattern(key)) step(design, key);
                  else looking.look({ design: key });
                }}
              />
            </label>
            <Upload take={(next) => step(design, next)} />
          </div>
        </div>
      </section>
      <section class="panel design" aria-label="design">
        <div class="panel-head">
          <h2>Design</h2>
        </div>
        {broken ? (
          <DesignBody
            key={broken}
            chosen={{
              design: broken,
              model: model === "start" ? model : Number(model),
              of: "drawn by hand",
              modulus: NaN,
              toughness: NaN,
              isSimulated: false,
            }}
            data={data}
          />
        ) : (
          <p class="quiet">
            T, its film, and having it measured: press “Break it”. A simulation takes some seconds.
          </p>
        )}
      </section>
    </div>
  );
}

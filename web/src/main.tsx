// The page: header, nodes, and one view at a time, kept live.

import { render } from "preact";
import { useEffect, useState } from "preact/hooks";
import { get, Refusal, type Live, type Rounds, type RunInfo } from "./api";
import { ThemeContext } from "./chart";
import { DiagnosisView } from "./diagnosis";
import { Explorer } from "./explorer";
import { FamiliesView } from "./families";
import { Game } from "./game";
import { LaboratoryView } from "./laboratory";
import { NodesView, NodeStrip } from "./nodes";
import { useRepeated, useStored } from "./parts";
import { nameRun } from "./save";
import { statusOf } from "./status";
import { WordsView } from "./words";
import "./page.css";

const VIEWS = {
  game: "Game",
  laboratory: "Laboratory",
  diagnosis: "Diagnosis",
  families: "Families",
  explorer: "Explorer",
  nodes: "Nodes",
  words: "Words",
} as const;
type View = keyof typeof VIEWS;
const LIVE_MS = 1000;

const viewOfAddress = (): View => {
  const name = location.hash.slice(1);
  return name in VIEWS ? (name as View) : "game";
};

function useView(): View {
  const [view, setView] = useState(viewOfAddress);
  useEffect(() => {
    const follow = () => setView(viewOfAddress());
    addEventListener("hashchange", follow);
    return () => removeEventListener("hashchange", follow);
  }, []);
  return view;
}

/** Dark or light: as the system is set, unless the person has chosen. */
function useTheme(): ["light" | "dark", () => void] {
  const [stored, setStored] = useStored("theme", "");
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const [system, setSystem] = useState(dark.matches ? "dark" : "light");
  useEffect(() => {
    const follow = () => setSystem(dark.matches ? "dark" : "light");
    dark.addEventListener("change", follow);
    return () => dark.removeEventListener("change", follow);
  }, []);
  const theme = (stored || system) as "light" | "dark";
  document.documentElement.dataset.theme = theme;
  return [theme, () => setStored(theme === "dark" ? "light" : "dark")];
}

function Page() {
  const [info, setInfo] = useState<RunInfo | null>(null);
  const [live, setLive] = useState<Live | null>(null);
  const [rounds, setRounds] = useState<Rounds>({ rounds: [], measured: [], revealed: null });
  const [data, setData] = useState<string | null>(null);
  const [lost, setLost] = useState("");
  const view = useView();
  const [theme, flipTheme] = useTheme();
  useRepeated(async () => {
    try {
      const now = await get<Live>("/api/live");
      // The report is written after the first round's data, and the last one while the nodes come to an end.
      const isNew = now.data !== data || now.playing !== live?.playing;
      setLive(now);
      if (!info || (isNew && !info.report)) setInfo(await get<RunInfo>("/api/run"));
      if (now.data !== data) {
        const next = await get<Rounds>("/api/rounds");
        setRounds((before) => (JSON.stringify(before) === JSON.stringify(next) ? before : next));
        setData(now.data);
      }
      setLost("");
    } catch (error) {
      setLost(error instanceof Refusal ? error.message : "The dashboard was stopped: start nacre dashboard again.");
    }
  }, LIVE_MS);
  useEffect(() => {
    if (!info) return;
    document.title = `${info.run} · nacre`;
    nameRun(info.run);
  }, [info]);
  if (!info) return <p class="awaited wait">{lost || "reading the run …"}</p>;
  const { text, kind, link } = statusOf(info, rounds, live, lost);
  const playing = live?.playing ?? false;
  return (
    <ThemeContext.Provider value={theme}>
      <a
        class="skip"
        href="#main"
        onClick={(e) => {
          e.preventDefault();
          document.getElementById("main")!.focus();
        }}
      >
        to the content
      </a>
      <header>
        <div class="title">
          <p class="eyebrow">nacre</p>
          <h1>{info.run}</h1>
          <p class={`standing ${kind}`} role="status">
            <span class="dot" aria-hidden="true" />
            {link ? <a href={link}>{text}</a> : text}
          </p>
        </div>
        <nav aria-label="views">
          {(Object.keys(VIEWS) as View[]).map((each) => (
            <a key={each} href={`#${each}`} aria-current={each === view ? "page" : undefined}>
              {VIEWS[each]}
            </a>
          ))}
        </nav>
        <div class="aside">
          {info.report && (
            <a href="/report" target="_blank" rel="noopener">
              report
            </a>
          )}
          <button
            type="button"
            class="quiet"
            onClick={flipTheme}
            aria-label={theme === "dark" ? "light colours" : "dark colours"}
          >
            {theme === "dark" ? "light" : "dark"}
          </button>
        </div>
      </header>
      {live && live.nodes.length > 0 && view !== "nodes" && view !== "words" && <NodeStrip live={live} />}
      <main id="main" tabIndex={-1}>
        {info.fidelity === "tiny" && (
          <p class="awaited">Tiny specimens, for trying things out: the numbers on this page mean nothing.</p>
        )}
        {view === "game" && <Game rounds={rounds} data={data} theme={theme} playing={playing} />}
        {view === "laboratory" && <LaboratoryView info={info} rounds={rounds} playing={playing} />}
        {view === "diagnosis" && <DiagnosisView rounds={rounds} isOn={info.diagnosis} />}
        {view === "families" && <FamiliesView rounds={rounds} data={data} theme={theme} run={info.run} />}
        {view === "explorer" && <Explorer rounds={rounds} data={data} theme={theme} />}
        {view === "nodes" && live && <NodesView live={live} />}
        {view === "words" && <WordsView />}
      </main>
      <footer class="quiet">
        {info.scenario}, {info.fidelity} specimens · started {info.started.replace("T", " ").replace("Z", " UTC")} ·
        nacre {info.nacre_version} · <a href="#words">What do the words mean?</a>
      </footer>
    </ThemeContext.Provider>
  );
}

render(<Page />, document.getElementById("page")!);

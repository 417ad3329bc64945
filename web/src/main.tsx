// The page: at each address a view of a run, kept live, or the list of runs.

import { render, type ComponentChildren } from "preact";
import { useEffect, useMemo, useState } from "preact/hooks";
import { get, ofRun, openRun, Refusal, type ListedRun, type Live, type Rounds, type RunInfo, type Runs } from "./api";
import { ThemeContext } from "./chart";
import { DiagnosisView } from "./diagnosis";
import { EditorView } from "./editor";
import { Explorer } from "./explorer";
import { FamiliesView } from "./families";
import { Game } from "./game";
import { LaboratoryView } from "./laboratory";
import { NodesView, NodeStrip } from "./nodes";
import { Awaited, Nowhere, useRepeated, useStored } from "./parts";
import { useResponse } from "./reading";
import { addressOf, lookingAt, RUNS, useRoute, VIEWS, type At, type Route, type View } from "./route";
import { RunContext } from "./run_context";
import { RunsView } from "./runs";
import { statusOf } from "./status";
import { WordsView } from "./words";
import "./page.css";

const LIVE_MS = 1000;
const LIST_MS = 2000;

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

interface Theme {
  theme: "light" | "dark";
  flip: () => void;
}

function Header({
  eyebrow,
  title,
  standing,
  theme: { theme, flip },
  nav,
  aside,
}: {
  eyebrow: ComponentChildren;
  title: string;
  standing: ComponentChildren;
  theme: Theme;
  nav?: ComponentChildren;
  aside?: ComponentChildren;
}) {
  return (
    <>
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
          <p class="eyebrow">{eyebrow}</p>
          <h1>{title}</h1>
          {standing}
        </div>
        {nav && <nav aria-label="views">{nav}</nav>}
        <div class="aside">
          {aside}
          <button
            type="button"
            class="quiet"
            onClick={flip}
            aria-label={theme === "dark" ? "light colours" : "dark colours"}
          >
            {theme === "dark" ? "light" : "dark"}
          </button>
        </div>
      </header>
    </>
  );
}

/** What the browser calls the page: what is looked at, then where. */
function useTitle(...parts: (string | undefined)[]): void {
  const title = [...parts.filter(Boolean), "nacre"].join(" · ");
  useEffect(() => {
    document.title = title;
  }, [title]);
}

const titleOfView = (view: View, { design, specimen, round, map }: At) =>
  [design ?? specimen, map && `map ${map}`, round && `round ${round}`, VIEWS[view]].filter(Boolean).join(" · ");

/** One run, live. */
function RunPage({
  run,
  view,
  at,
  theme,
  several,
}: {
  run: string;
  view: View;
  at: At;
  theme: Theme;
  /** How many runs there are. */
  several: number;
}) {
  const [info, setInfo] = useState<RunInfo | null>(null);
  const [live, setLive] = useState<Live | null>(null);
  const [rounds, setRounds] = useState<Rounds>({ rounds: [], measured: [], revealed: null });
  const [data, setData] = useState<string | null>(null);
  const [lost, setLost] = useState("");
  useRepeated(async () => {
    try {
      const now = await get<Live>("/api/live", {}, run);
      // The report is written after the first round's data, and the last one while the nodes come to an end.
      const isNew = now.data !== data || now.playing !== live?.playing;
      setLive(now);
      if (!info || (isNew && !info.report)) setInfo(await get<RunInfo>("/api/run", {}, run));
      if (now.data !== data) {
        const next = await get<Rounds>("/api/rounds", {}, run);
        setRounds((before) => (JSON.stringify(before) === JSON.stringify(next) ? before : next));
        setData(now.data);
      }
      setLost("");
    } catch (error) {
      setLost(error instanceof Refusal ? error.message : "The dashboard was stopped: start nacre dashboard again.");
    }
  }, LIVE_MS);
  const playing = live?.playing ?? false;
  const open = useMemo(() => info && { ...info, playing }, [info, playing]);
  useTitle(titleOfView(view, at), run);
  const eyebrow = several > 1 ? <a href={RUNS}>all {several} runs</a> : "nacre";
  if (!info)
    return (
      <>
        {several > 1 && <Header eyebrow={eyebrow} title={run} standing={null} theme={theme} />}
        <p class="awaited wait">{lost || "reading the run …"}</p>
      </>
    );
  const { text, kind, link } = statusOf(info, rounds, live, lost);
  const isOver = rounds.rounds.some((r) => r.summary?.last);
  const looking = lookingAt(view, at);
  const common = { rounds, data, theme: theme.theme, isOver, looking };
  return (
    <>
      <Header
        eyebrow={eyebrow}
        title={run}
        standing={
          <p class={`standing ${kind}`} role="status">
            <span class="dot" aria-hidden="true" />
            {link ? <a href={link}>{text}</a> : text}
          </p>
        }
        theme={theme}
        nav={(Object.keys(VIEWS) as View[]).map((each) => (
          <a key={each} href={addressOf(each)} aria-current={each === view ? "page" : undefined}>
            {VIEWS[each]}
          </a>
        ))}
        aside={
          info.report && (
            <a href={ofRun("/report")} target="_blank" rel="noopener">
              report
            </a>
          )
        }
      />
      {live && live.nodes.length > 0 && view !== "nodes" && view !== "words" && <NodeStrip live={live} />}
      <RunContext.Provider value={open}>
        <main id="main" tabIndex={-1}>
          {info.fidelity === "tiny" && (
            <p class="awaited">Tiny specimens, for trying things out: the numbers on this page mean nothing.</p>
          )}
          {view === "game" && <Game {...common} playing={playing} />}
          {view === "laboratory" && <LaboratoryView {...common} info={info} playing={playing} />}
          {view === "diagnosis" && <DiagnosisView {...common} isRead={data !== null} isOn={info.diagnosis} />}
          {view === "families" && <FamiliesView {...common} run={run} />}
          {view === "explorer" && <Explorer {...common} />}
          {view === "editor" && <EditorView {...common} />}
          {view === "nodes" && live && <NodesView live={live} />}
          {view === "words" && <WordsView />}
        </main>
      </RunContext.Provider>
      <footer class="quiet">
        {info.scenario}, {info.fidelity} specimens · started {info.started.replace("T", " ").replace("Z", " UTC")} ·
        nacre {info.nacre_version} · <a href={addressOf("words")}>What do the words mean?</a>
      </footer>
    </>
  );
}

/** All runs beside each other. */
function RunsPage({ runs, problem, theme }: { runs: ListedRun[]; problem: string; theme: Theme }) {
  useTitle("Runs");
  const playing = runs.filter((r) => r.state === "playing").length;
  return (
    <>
      <Header
        eyebrow="nacre"
        title="Runs"
        standing={
          <p class={`standing ${problem ? "bad" : playing ? "good" : "rest"}`} role="status">
            <span class="dot" aria-hidden="true" />
            {problem || `${runs.length} ${runs.length === 1 ? "run" : "runs"}, ${playing || "none"} playing`}
          </p>
        }
        theme={theme}
      />
      <main id="main" tabIndex={-1}>
        <RunsView runs={runs} theme={theme.theme} />
      </main>
    </>
  );
}

/** In place of the page where there is nothing at its address. */
function NowherePage({ why, theme, link }: { why: string; theme: Theme; link: string }) {
  useTitle("Nothing here");
  return (
    <>
      <Header eyebrow="nacre" title="Nothing here" standing={null} theme={theme} />
      <main id="main" tabIndex={-1}>
        <Nowhere why={why} link={link} />
      </main>
    </>
  );
}

/** The page at an address. */
function Routed({ route, runs, problem, theme }: { route: Route; runs: ListedRun[]; problem: string; theme: Theme }) {
  const first = (runs.find((r) => r.state !== "unreadable") ?? runs[0]).run;
  const isList = route.page === "runs" || (route.page === "start" && runs.length > 1);
  const { view, at } = route.page === "view" ? route : { view: "game" as const, at: {} };
  const run = route.page === "view" || route.page === "nowhere" ? (route.run ?? first) : first;
  const isThere = runs.some((r) => r.run === run);
  const isView = !isList && route.page !== "nowhere" && isThere;
  openRun(isView ? run : "");
  const whole = isView ? addressOf(view, at, run) : null;
  // An address that leaves out the run would lead elsewhere on another page.
  useEffect(() => {
    if (whole && (route.page === "start" || (route.page === "view" && route.run === null)))
      history.replaceState(null, "", whole);
  }, [whole, route.page]);
  if (isList) return <RunsPage runs={runs} problem={problem} theme={theme} />;
  if (!isThere) {
    const why = `There is no run “${run}” on this page: it shows ${runs.map((r) => r.run).join(", ")}.`;
    return <NowherePage why={why} theme={theme} link={runs.length > 1 ? RUNS : addressOf("game", {}, first)} />;
  }
  if (route.page === "nowhere")
    return <NowherePage why={route.why} theme={theme} link={addressOf("game", {}, run)} />;
  return <RunPage key={run} run={run} view={view} at={at} theme={theme} several={runs.length} />;
}

function Page() {
  const [theme, flip] = useTheme();
  const { value, problem, read } = useResponse<Runs>("/api/runs", {}, "");
  const route = useRoute();
  const isLive = value === null || (value.runs.length > 1 && route.page !== "view");
  useRepeated(read, LIST_MS, isLive);
  if (!value) return <Awaited problem={problem} what="reading the runs …" />;
  return (
    <ThemeContext.Provider value={theme}>
      <Routed route={route} runs={value.runs} problem={problem} theme={{ theme, flip }} />
    </ThemeContext.Provider>
  );
}

render(<Page />, document.getElementById("page")!);

// What every part of a run's page may ask: which run it is, and whether it is played.

import { createContext } from "preact";
import { useContext } from "preact/hooks";
import type { RunInfo } from "./api";

export type OpenRun = RunInfo & { playing: boolean };

export const RunContext = createContext<OpenRun | null>(null);

/** The open run; null where there is none yet. */
export const useOpenRun = () => useContext(RunContext);

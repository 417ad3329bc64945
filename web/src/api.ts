// The server's responses (docs/FORMATS.md, "Dashboard") and how they are asked for. SI units.

export type * from "./page_types";

export interface Simulation {
  state: "absent" | "queued" | "working" | "ready" | "failed";
  source: "run" | "here";
  working_s?: number;
  modulus_pa?: number | null;
  problem?: string;
}

export interface PatternMap {
  id: string;
  pattern: string[];
  source: string[];
  x: number[];
  y: number[];
  modulus_pa: (number | null)[];
  toughness_pa: (number | null)[];
  triangles: [number, number, number][];
  residual_variance: number | null;
}

export interface Maps {
  families: {
    name: string;
    seeds: number;
    samples?: number;
    map_ids: string[];
    mechanisms?: Mechanism[];
    maps?: Subfamily[];
  }[];
  gamuts: string[];
}

export interface Mechanism {
  mechanism: string;
  patterns: number;
  spearman_with_toughness: number;
  partial: number;
  p_family_wise: number;
}

/** The map of one seed's surroundings, as `nacre families` made it. */
interface Subfamily {
  seed: string;
  sampled: number;
  interpolated: number;
  growth: number;
  residual_variance: number;
}

export interface Between {
  pattern: string | null;
  rigid_fraction?: number;
  violation: string | null;
}

/** What is understood of uploaded files, as `nacre import --json` says it. */
export interface Understood {
  specimens: UnderstoodSpecimen[];
  rejected: ImportFault[];
  warnings: string[];
  answers?: { specimen: string; answer: string; error?: string }[];
}

export interface UnderstoodSpecimen {
  specimen: string;
  file: string;
  line: number;
  maker: string;
  pattern: string;
  test: string;
  orientation_deg: number;
  thickness_mm: number;
  modulus_pa: number;
  modulus_error_pa: number | null;
  toughness_pa: number | null;
  peak_stress_pa: number | null;
  failure_strain: number | null;
  toe_strain: number | null;
  gauge_mm: number;
  strain_rate_per_s: number;
  rate_source: string;
  extension_column: string;
  columns: Record<string, string>;
  decisions: string[];
  curve: { strain: number[]; stress_pa: number[] };
  doubts: { of_scale: boolean; text: string }[];
  valid: boolean;
  note: string;
}

export interface ImportFault {
  file: string;
  specimen: string;
  line: number;
  column: string;
  reason: string;
}

/** A request that the server refused, with its sentence. */
export class Refusal extends Error {
  constructor(
    readonly status: number,
    message: string,
  ) {
    super(message);
  }
}

/** Why there is no response, as a sentence for the page. */
export function problemOf(error: unknown): string {
  if (error instanceof Refusal) return error.message;
  // What fetch throws; anything else comes from reading what did arrive.
  return error instanceof TypeError ? "The server does not respond." : "The server's response cannot be read.";
}

const TOO_LARGE = "This is too large: at most 4 MiB at a time, curve included; of files 64 MiB.";

/** The reason in a refusal: a sentence of the server, or its text where that is not JSON. */
function reasonIn(text: string): string {
  try {
    const { message, error } = JSON.parse(text) as { message?: string; error?: string };
    return message || error || "";
  } catch {
    return text.slice(0, 300);
  }
}

/** The response; throws a Refusal where it is one. */
async function accepted(response: Response): Promise<Response> {
  if (response.ok) return response;
  const reason = response.status === 413 ? TOO_LARGE : reasonIn(await response.text());
  throw new Refusal(response.status, reason || response.statusText || `The server refused: status ${response.status}.`);
}

let opened = "";

/** The run that is looked at: requests, files and drafts are its own. Empty: none is. */
export const openedRun = () => opened;
export function openRun(name: string): void {
  opened = name;
}

/** The server's address of something of a run. */
export const ofRun = (path: string, run = opened) => (run ? `/runs/${encodeURIComponent(run)}${path}` : path);

export type Query = Record<string, string | number>;

export function address(path: string, query: Query): string {
  const parameters = new URLSearchParams(Object.entries(query).map(([name, value]) => [name, String(value)]));
  return parameters.size > 0 ? `${path}?${parameters}` : path;
}

export async function get<T>(path: string, query: Query = {}, run = opened): Promise<T> {
  return (await accepted(await fetch(ofRun(address(path, query), run)))).json();
}

export async function getBytes(path: string, query: Query = {}): Promise<ArrayBuffer> {
  return (await accepted(await fetch(ofRun(address(path, query))))).arrayBuffer();
}

export async function post<T>(path: string, body: unknown): Promise<T> {
  const headers = { "Content-Type": "application/json", "X-Nacre": "1" };
  return (await accepted(await fetch(ofRun(path), { method: "POST", headers, body: JSON.stringify(body) }))).json();
}

/** Files for the reader of exports; `signal` gives it up. */
export async function postFiles<T>(path: string, files: FormData, signal: AbortSignal): Promise<T> {
  const headers = { "X-Nacre": "1" };
  return (await accepted(await fetch(ofRun(path), { method: "POST", headers, body: files, signal }))).json();
}

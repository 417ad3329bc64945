// The server's responses (docs/FORMATS.md, "Dashboard"). SI units.

export interface RunInfo {
  run: string;
  scenario: string;
  fidelity: string;
  rounds: number;
  approval: boolean;
  virtual_lab: boolean;
  diagnosis: boolean;
  replicates: number;
  started: string;
  nacre_version: string;
  commit: string;
  report: boolean;
  user: string;
}

export interface NodeState {
  node: string;
  state: "starting" | "running" | "finished" | "ended" | "silent";
  age_s: number;
  phase: string;
  round: number;
  progress: number | null;
  eta_s: number | null;
  received: number;
  published: number;
  retries: number;
  duplicates: number;
  rejected: number;
  lost: number;
  dropped: number;
  unacknowledged: number;
  queued: number;
  owed: number;
  computing: number;
  journal_bytes: number;
  work: string;
  last_problem: string;
}

export interface Live {
  playing: boolean;
  data: string;
  nodes: NodeState[];
}

export interface Errors {
  modulus_count: number;
  modulus_mean: number;
  modulus_max: number;
  toughness_count: number;
  toughness_mean: number;
  toughness_max: number;
  toughness_spearman: number;
}

interface Summary {
  fidelity: string;
  calibration_count: number;
  measured_hypervolume: number;
  gamut_hypervolume: number;
  hypervolume_error: number;
  gap: number;
  signed_gap: number;
  before: Errors | null;
  after: Errors | null;
  held_out: Errors | null;
  equilibrium: boolean;
  last: boolean;
  decided_by: string;
}

export interface Proposed {
  design: string;
  modulus_pa: number;
  toughness_pa: number;
  reason: string;
}

export interface Round {
  round: number;
  summary: Summary | null;
  gamut_count: number;
  measured_front: [number, number][];
  benchmark: [number, number][];
  proposals: Proposed[];
  parameters: Record<string, number>;
  verdict: string | null;
}

export interface Measured {
  design: string;
  round: number;
  rigid_fraction: number;
  modulus_pa: number;
  modulus_sd_pa: number;
  modulus_count: number;
  toughness_pa: number;
  toughness_sd_pa: number;
  toughness_count: number;
}

export interface Rounds {
  rounds: Round[];
  measured: Measured[];
}

export interface Curve {
  strain: number[];
  stress_pa: number[];
}

export interface Specimen {
  specimen: string;
  round: number;
  test: string;
  orientation_deg: number;
  batch: string;
  modulus_pa: number | null;
  toughness_pa: number | null;
  valid: boolean;
  note: string;
  /** Tested at the usual rate and thickness. */
  standard?: boolean;
  curve: Curve | null;
}

export interface Design {
  design: string;
  rigid_fraction: number;
  violation?: string | null;
  proposals: (Proposed & { round: number })[];
  simulated: {
    round: number;
    failure?: string;
    modulus_pa?: number | null;
    toughness_pa?: number;
    curve?: Curve | null;
  }[];
  cracks: { round: number; film: boolean; path_ratio?: number; branches: number; bridged_share?: number }[];
  specimens: Specimen[];
}

export interface Simulation {
  state: "absent" | "queued" | "working" | "ready" | "failed";
  source: "run" | "here";
  working_s?: number;
  modulus_pa?: number | null;
  problem?: string;
}

export interface LaboratorySpecimen {
  specimen: string;
  design: string;
  test: string;
  orientation_deg: number;
  strain_rate_per_s: number;
  thickness_mm: number;
  /** The usual rate and thickness. */
  standard: boolean;
  batch: string;
  modulus_pa: number | null;
  toughness_pa: number | null;
  points: number;
  valid: boolean;
  note: string;
  /** Who reviewed it last and why; absent or empty: nobody has. */
  by?: string;
  why?: string;
}

export interface Order {
  order: string;
  round: number;
  design: string;
  test: string;
  orientation_deg: number;
  strain_rate_per_s: number;
  thickness_mm: number;
  loading: string;
  batch: string;
  replicates: number;
  arrived: number;
  valid: number;
  complete: boolean;
  reason: string;
}

export interface DesignState {
  design: string;
  state: string;
  proposed_in_round: number | null;
  ordered: number;
  printed: number;
  measured: number;
  valid: number;
  by: string;
  why: string;
}

export interface Group {
  design: string;
  test: string;
  orientation_deg: number;
  strain_rate_per_s: number;
  thickness_mm: number;
  /** The usual rate and thickness. */
  standard: boolean;
  state: string;
  tested: string[];
  valid: string[];
  proposed_outliers: { specimen: string; reasons: string[] }[];
  wanted: number;
  /** Null where no specimen is valid; the scatter of one, too. */
  mean_pa: number | null;
  scatter: number | null;
  /** The same without the proposed outliers. */
  mean_without_pa: number | null;
  scatter_without: number | null;
}

export interface Laboratory {
  proposal: { round: number; simulations: number; designs: (Proposed & { bin: number })[] } | null;
  designs: DesignState[];
  orders: Order[];
  specimens: LaboratorySpecimen[];
  groups: Group[];
}

export interface Effect {
  name: string;
  family?: string;
  explanation?: string;
  parameter: number;
  interval90: [number, number];
  unit: string;
}

export interface CandidateEffect {
  name: string;
  family?: string;
  explanation?: string;
  status: string;
  statistic: number;
  p_family_wise: number;
  absorption: number;
}

export interface Experiment {
  design: string;
  test: string;
  orientation_deg: number;
  strain_rate_per_s: number;
  thickness_mm: number;
  replicates: number;
  loading: string;
  reason: string;
}

export interface Diagnosis {
  round: number;
  verdict: string;
  summary: string;
  /** Where the calibration of the round contradicts the verdict; empty: nowhere. */
  against: string;
  effects: Effect[];
  candidates: CandidateEffect[];
  gain: {
    held_out_error_before: number;
    held_out_error_after: number;
    relative_reduction?: number;
    interval90?: [number, number];
  } | null;
  next_experiments: Experiment[];
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

/** E and T as far as they are known. */
interface Values {
  modulus_pa: number | null;
  toughness_pa: number | null;
}

export interface FamilyDesign {
  design: string;
  is_seed: boolean;
  rigid_fraction: number;
  measured: Values;
  global_model: Values;
  family_model: Values;
  film: boolean;
}

export interface Family {
  number: number;
  name: string;
  round: number;
  is_validated: boolean;
  simulations: number;
  samples: number;
  gamut_count: number;
  designs: FamilyDesign[];
  errors: Record<"seeds" | "chosen", Record<"global" | "family", Errors | null>>;
  over_fits: ("E" | "T")[];
}

export interface NamedSeeds {
  name: string;
  seeds: string[];
}

export interface Families {
  enabled: boolean;
  stage: Family[];
  grouping: { from: "file" | "proposal"; problem: string; families: NamedSeeds[]; near_pareto: string[] };
}

export interface Between {
  pattern: string | null;
  rigid_fraction?: number;
  violation: string | null;
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

const TOO_LARGE = "This is too large: at most 4 MiB at a time, curve included.";

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

export type Query = Record<string, string | number>;

export function address(path: string, query: Query): string {
  const parameters = new URLSearchParams(Object.entries(query).map(([name, value]) => [name, String(value)]));
  return parameters.size > 0 ? `${path}?${parameters}` : path;
}

export async function get<T>(path: string, query: Query = {}): Promise<T> {
  return (await accepted(await fetch(address(path, query)))).json();
}

export async function getBytes(path: string, query: Query = {}): Promise<ArrayBuffer> {
  return (await accepted(await fetch(address(path, query)))).arrayBuffer();
}

export async function post<T>(path: string, body: unknown): Promise<T> {
  const headers = { "Content-Type": "application/json", "X-Nacre": "1" };
  return (await accepted(await fetch(path, { method: "POST", headers, body: JSON.stringify(body) }))).json();
}

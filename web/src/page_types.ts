// The server's responses, SI units (docs/FORMATS.md, "Dashboard"). Written by nacre_page_types from the tables of
// fields in lib/dashboard: not to be edited.

export interface ListedRun {
  run: string;
  state: "playing" | "finished" | "stopped" | "unreadable";
  problem: string;
  scenario: string;
  fidelity: string;
  rounds: number;
  round: number | null;
  data: string;
  measured_hypervolume: number | null;
  hypervolume_error: number | null;
  gap: number | null;
}

export interface Runs {
  runs: ListedRun[];
}

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
  n_modulus: number;
  modulus_mean: number;
  modulus_max: number;
  n_toughness: number;
  toughness_mean: number;
  toughness_max: number;
  toughness_spearman: number;
}

export interface Summary {
  round: number;
  fidelity: string;
  n_calibration: number;
  measured_hypervolume_staircase: number;
  measured_hypervolume_polygon: number;
  gamut_hypervolume_staircase: number;
  gamut_hypervolume_polygon: number;
  gap: number;
  signed_gap: number;
  hypervolume_error: number;
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
  toughness_sd_pa: number;
  specimens: number;
  bin: number;
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

export interface HiddenCause {
  name: string;
  meaning: string;
  in_library: boolean;
  values: number[];
}

export interface Revealed {
  causes: HiddenCause[];
  modulus_noise: number;
  toughness_noise: number;
  parameters: Record<string, number>;
}

export interface Rounds {
  rounds: Round[];
  measured: Measured[];
  revealed: Revealed | null;
}

export interface ProposedInRound {
  round: number;
  design: string;
  modulus_pa: number;
  toughness_pa: number;
  toughness_sd_pa: number;
  specimens: number;
  bin: number;
  reason: string;
}

export interface Curve {
  strain: number[];
  stress_pa: number[];
}

export interface SimulatedInRound {
  round: number;
  failure: string;
  modulus_pa: number | null;
  toughness_pa: number | null;
  curve: Curve | null;
}

export interface CrackInRound {
  round: number;
  film: boolean;
  broken: number;
  branches: number;
  separate_cracks: number;
  path_ratio: number | null;
  bridged_share: number | null;
  soft_share: number | null;
  rigid_share: number | null;
  interface_share: number | null;
  crosses: boolean | null;
}

export interface Specimen {
  specimen: string;
  round: number;
  test: string;
  orientation_deg: number;
  strain_rate_per_s: number;
  thickness_mm: number;
  standard: boolean;
  batch: string;
  modulus_pa: number | null;
  toughness_pa: number | null;
  valid: boolean;
  note: string;
  curve: Curve | null;
}

export interface Design {
  design: string;
  rigid_fraction: number;
  violation: string | null;
  proposals: ProposedInRound[];
  simulated: SimulatedInRound[];
  cracks: CrackInRound[];
  specimens: Specimen[];
}

export interface DesignCheck {
  design: string;
  rigid_fraction: number;
  violations: string[];
  soft_corner: string;
  modulus_pa: number | null;
  problem: string;
}

export interface DesignMechanisms {
  design: string;
  model: string;
  deflection: number;
  branching: number;
  bridging: number;
  soft_arrest: number;
  guidance: number;
}

export interface Mechanisms {
  designs: DesignMechanisms[];
}

export interface OpenProposal {
  round: number;
  simulations: number;
  designs: Proposed[];
}

export interface Price {
  specimens: number;
  trays: number;
  slices: number;
  printing_h: number;
  testing_h: number;
  resin_ml: number;
}

export interface RoundPrice {
  round: number;
  is_expected: boolean;
  all: Price;
  left: Price;
  budget: string;
  sentence: string;
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

export interface Order {
  order: string;
  round: number;
  design: string;
  test: string;
  orientation_deg: number;
  strain_rate_per_s: number;
  thickness_mm: number;
  standard: boolean;
  width_mm: number;
  gauge_mm: number;
  loading: string;
  batch: string;
  replicates: number;
  arrived: number;
  valid: number;
  complete: boolean;
  reason: string;
  withdrawn: boolean;
  by: string;
  why: string;
}

export interface Printed {
  label: string;
  design: string;
  test: string;
  orientation_deg: number;
  order: string;
}

export interface EarlierReport {
  revision: number;
  design: string;
  test: string;
  orientation_deg: number;
  strain_rate_per_s: number;
  thickness_mm: number;
  standard: boolean;
  modulus_pa: number | null;
  toughness_pa: number | null;
  by: string;
  why: string;
}

export interface LaboratorySpecimen {
  specimen: string;
  design: string;
  test: string;
  orientation_deg: number;
  strain_rate_per_s: number;
  thickness_mm: number;
  standard: boolean;
  batch: string;
  modulus_pa: number | null;
  toughness_pa: number | null;
  points: number;
  valid: boolean;
  note: string;
  by: string;
  why: string;
  amended_by: string;
  amended_why: string;
  earlier: EarlierReport[];
}

export interface ProposedOutlier {
  specimen: string;
  reasons: string[];
}

export interface Group {
  design: string;
  test: string;
  orientation_deg: number;
  strain_rate_per_s: number;
  thickness_mm: number;
  standard: boolean;
  state: string;
  tested: string[];
  valid: string[];
  proposed_outliers: ProposedOutlier[];
  wanted: number;
  mean_pa: number | null;
  scatter: number | null;
  mean_without_pa: number | null;
  scatter_without: number | null;
  representative: string;
}

export interface Laboratory {
  proposal: OpenProposal | null;
  price: RoundPrice | null;
  designs: DesignState[];
  orders: Order[];
  printed: Printed[];
  specimens: LaboratorySpecimen[];
  groups: Group[];
}

export interface Growth {
  mean_gpa_mpa: number;
  error_gpa_mpa: number;
  interval90_gpa_mpa: [number, number];
}

export interface Brought {
  round: number;
  growth: Growth;
}

export interface NextRound {
  round: number;
  hypervolume_gpa_mpa: number;
  brought: Brought[];
  expected: Growth | null;
  is_scatter_of_fit: boolean;
  sentence: string;
  price: Price;
}

export interface ToldMeasurement {
  revision: number;
  by: string;
  why: string;
  order: string;
  round: number;
  design: string;
  test: string;
  orientation_deg: number;
  strain_rate_per_s: number;
  thickness_mm: number;
  standard: boolean;
  batch: string;
  print_order: number;
  modulus_pa: number | null;
  toughness_pa: number | null;
  modulus_of_curve_pa: number | null;
  toughness_of_curve_pa: number | null;
  points: number;
  valid: boolean;
  note: string;
}

export interface ToldReview {
  revision: number;
  valid: boolean;
  by: string;
  why: string;
}

export interface SpecimenStory {
  specimen: string;
  measurements: ToldMeasurement[];
  reviews: ToldReview[];
}

export interface Note {
  id: string;
  about: string;
  name: string;
  by: string;
  when: string;
  text: string;
  photo: string;
}

export interface Notes {
  notes: Note[];
}

export interface Printer {
  name: string;
  words: string;
  tray_x_mm: number;
  tray_y_mm: number;
}

export interface PrintTray {
  tray: number;
  batch: string;
  labels: string[];
}

export interface PrintJob {
  job: string;
  state: string;
  progress: number;
  problem: string;
  has_files: boolean;
  printer: string;
  price: string;
  trays: PrintTray[];
}

export interface PrintJobs {
  printers: Printer[];
  unprinted: number;
  jobs: PrintJob[];
}

export interface Effect {
  name: string;
  family: string;
  parameter: number;
  interval_low: number;
  interval_high: number;
  unit: string;
  explanation: string;
}

export interface CandidateEffect {
  name: string;
  status: "in_set" | "excluded" | "invisible" | "not_simulated" | "not_applicable";
  statistic: number;
  p_family_wise: number;
  absorption: number;
  family: string;
  explanation: string;
}

export interface Gain {
  held_out_error_before: number;
  held_out_error_after: number;
  relative_reduction: number;
  reduction_low: number;
  reduction_high: number;
}

export interface Experiment {
  design: string;
  test: string;
  orientation_deg: number;
  strain_rate_per_s: number;
  thickness_mm: number;
  standard: boolean;
  replicates: number;
  loading: string;
  reason: string;
}

export interface Diagnosis {
  round: number;
  verdict: string;
  summary: string;
  against: string;
  effects: Effect[];
  candidates: CandidateEffect[];
  gain: Gain | null;
  next_experiments: Experiment[];
}

export interface Values {
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

export interface ModelErrors {
  global: Errors | null;
  family: Errors | null;
}

export interface FamilyErrors {
  seeds: ModelErrors;
  chosen: ModelErrors;
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
  errors: FamilyErrors;
  over_fits: string[];
  parameters: Record<string, number>;
}

export interface NamedSeeds {
  name: string;
  seeds: string[];
}

export interface Grouping {
  from: "file" | "proposal";
  problem: string;
  families: NamedSeeds[];
  near_pareto: string[];
}

export interface Families {
  enabled: boolean;
  stage: Family[];
  grouping: Grouping;
}

// The page's terms, each with an explanation for its tooltip. The words are those of docs/GLOSSARY.md.

/** What a heading says, and what it means. */
export interface Term {
  heading: string;
  hint: string;
}

const term = (heading: string, hint: string): Term => ({ heading, hint });

/** Of hypervolumes and gaps; unbroken, a heading may be narrow. */
export const AREA = "GPa\u00a0MPa";

export const TERMS = {
  run: term("run", "One played game."),
  scenario: term("scenario", "The settings of the game."),
  fidelity: term(
    "fidelity",
    "How specimens are simulated: full as in the thesis, fine on smaller elements, preview faster, tiny to try things.",
  ),
  runState: term("state", "playing, finished, stopped before its end, or what cannot be read."),
  roundsDone: term("rounds", "The last complete round, of those that the scenario plans."),

  round: term("round", "Propose, measure, calibrate, diagnose. Round 0 has base materials alone."),
  design: term("design", "Whatever can be tested: a pattern of 20 x 20 pixels, a coupon or a mixture."),
  rigid: term("rigid share", "Share of rigid material."),
  modulus: term("E / GPa", "Young's modulus: how stiff. Mean and standard deviation of the specimens."),
  toughness: term(
    "T / MPa",
    "Toughness: energy per volume until the notched specimen separates. Mean and standard deviation of the specimens.",
  ),
  oneModulus: term("E / GPa", "Young's modulus of this specimen: how stiff."),
  oneToughness: term("T / MPa", "Toughness of this specimen: energy per volume until it separates."),
  specimens: term("specimens", "How many specimens gave E, and how many T."),

  predictedHypervolume: term(
    `predicted hypervolume / ${AREA}`,
    "Area under the Pareto front of all simulated patterns (the gamut), down to E = T = 0: what the model expects.",
  ),
  measuredHypervolume: term(
    `measured hypervolume / ${AREA}`,
    "Area under the Pareto front of the measured patterns, with its standard error over replicates.",
  ),
  gap: term(
    `gap / ${AREA}`,
    "Area between the predicted front and the measured one: how far simulation and laboratory are apart.",
  ),
  modulusError: term(
    "prediction error of\u00a0E",
    "Mean relative error of E on designs that were predicted before they were measured (out-of-sample).",
  ),
  toughnessError: term(
    "prediction error of\u00a0T",
    "Mean relative error of T on designs that were predicted before they were measured (out-of-sample).",
  ),
  toughnessRank: term(
    "rank correlation of\u00a0T",
    "Whether predicted and measured T have the same order (Spearman): 1 is the same, 0 none. From three designs on.",
  ),
  modulusFit: term("fit error of\u00a0E", "Mean relative error of E after calibration, on the designs used for it."),
  toughnessFit: term("fit error of\u00a0T", "Mean relative error of T after calibration, on the designs used for it."),
  equilibrium: term("equilibrium", "Whether two rounds running added nothing, and the comparison that decided it."),

  designState: term(
    "state",
    "How far the design has got: proposed, approved, printed, measured, or rejected or withdrawn.",
  ),
  proposedIn: term("proposed in round", "The round that proposed the design; a dash for designs that a person added."),
  ordered: term("ordered", "Specimens that the game has ordered."),
  printed: term("printed", "Specimens that have been printed."),
  measured: term("measured", "Specimens that have been tested."),
  valid: term("valid", "Tested specimens that count."),
  approval: term("approved or rejected by", "Who said yes or no to the design, or withdrew it, and why."),
  arrivedOf: term("measured of ordered", "Specimens of the order that have been tested, valid or not."),
  orderState: term("state", "Whether the order is open, or who withdrew it and why."),
  withdraw: term("withdraw", "Say that what is missing cannot be made, and why; undo while the round lasts."),

  test: term(
    "test",
    "modulus: a bar, slightly stretched. toughness: a notched specimen, pulled apart. tensile: a bar.",
  ),
  groupState: term("state", "Whether enough specimens of this design and test agree."),
  validOfTested: term("valid of tested", "Specimens that count, of those tested."),
  mean: term("mean", "Mean of the valid specimens."),
  scatter: term("scatter", "Standard deviation of the valid specimens, relative to their mean."),
  withoutOutliers: term("without outliers", "Mean and scatter without the specimens that look like outliers."),
  specimenValid: term("valid", "Whether the specimen counts."),
  remarks: term("remarks", "What looks wrong, the laboratory's note, who amended or reviewed the specimen and why."),
  review: term("review", "Say that the specimen counts or does not, or amend what was mistyped, and why."),

  effect: term("effect", "Physics that the base model lacks."),
  effectStatus: term("result", "What the measurements say of this effect."),
  fitGain: term(
    "better fit (Δχ²)",
    "By how much chi squared falls when this effect joins the base model. Larger: it explains more.",
  ),
  chance: term("p-value", "Chance that noise alone makes the best of all candidates do as well."),
  absorption: term(
    "absorption",
    "Share of the effect's signature that refitted base parameters imitate. At 100 % nothing is left to be seen.",
  ),

  family: term("family", "Similar good patterns with a model of their own."),
  role: term(
    "role",
    "seed: a measured design of the family. variant: a new one near a seed, chosen by the family's model.",
  ),
  globalE: term("E, global model", "With the model that is calibrated on all designs."),
  familyE: term("E, family model", "With the model that is calibrated on the seeds of this family alone."),
  globalT: term("T, global model", "With the model that is calibrated on all designs."),
  familyT: term("T, family model", "With the model that is calibrated on the seeds of this family alone."),
  familyModel: term(
    "family model",
    "Whether the family's own model predicts its variants better than the global model.",
  ),
  seed: term("seed", "The measured design around which variants were drawn."),
  sampled: term("sampled", "Variants drawn at random."),
  interpolated: term("interpolated", "Variants between others, found on the map."),
  growth: term("growth", "By how much the interpolated variants enlarge the hypervolume of the sampled ones."),
  variance: term("variance kept by the map", "How well distances on the map agree with distances between patterns."),

  mechanism: term("mechanism", "A property of the crack."),
  patterns: term("patterns", "How many patterns were looked at."),
  rank: term("rank correlation", "With toughness (Spearman): 1 is the same order, 0 none, -1 the opposite."),
  partial: term("partial rank correlation", "The same at equal rigid share and modulus."),
  mechanismChance: term("p-value", "Chance that the strongest of all mechanisms correlates as much by accident."),
} as const;

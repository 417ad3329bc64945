#pragma once
// Every constant of the thesis: value, unit, section or table, and whether it is stated there, follows from what is
// stated (inferred), or is this project's choice where the thesis is silent (chosen). Code elsewhere names these and
// repeats no number. Parameter ranges (Tables A.1, A.2) are in material/ranges.cpp, measured values in data/thesis/.

#include <string_view>

namespace nacre::thesis {

enum class Provenance { stated, inferred, chosen };

/// A number with its origin; converts to the number by itself.
template <class Number>
struct Constant {
  Number value;
  std::string_view unit;
  std::string_view source;
  Provenance status;
  constexpr operator Number() const { return value; }  // NOLINT: a constant is used as its value
};
using Real = Constant<double>;
using Count = Constant<int>;

// Patterns (2.1).
inline constexpr Count kPixelsPerSide{20, "pixels", "2.1", Provenance::stated};
inline constexpr Real kMinimumRigidFraction{0.50, "1", "2.1", Provenance::stated};
inline constexpr Real kMaximumRigidFraction{0.85, "1", "2.1", Provenance::stated};
inline constexpr Real kStiffRigidFraction{0.80, "1", "2.1: above it the whole corner is rigid", Provenance::stated};
inline constexpr Real kCornerRadius{4.0, "pixels", "2.1", Provenance::stated};

// Specimens and their tests (2.2).
inline constexpr Real kPixelSize{260e-6, "m", "2.2.1", Provenance::stated};
inline constexpr Count kPrinterResolutionX{300, "dpi", "2.2.1", Provenance::stated};
inline constexpr Count kPrinterResolutionY{600, "dpi", "2.2.1", Provenance::stated};
inline constexpr Count kPrinterResolutionZ{800, "dpi", "2.2.1", Provenance::stated};
inline constexpr Real kSpecimenLength{104e-3, "m", "2.2.2", Provenance::stated};
inline constexpr Real kSpecimenWidth{52e-3, "m", "2.2.2", Provenance::stated};
inline constexpr Real kSpecimenThickness{3.2e-3, "m", "2.2.2", Provenance::stated};
inline constexpr Real kGaugeLength{54e-3, "m", "2.2.2", Provenance::stated};
inline constexpr Real kNotchLength{10.4e-3, "m", "2.2.2", Provenance::stated};
inline constexpr Real kCutDepth{7.8e-3, "m", "2.2.2", Provenance::stated};
inline constexpr Real kGripSpeed{2e-3 / 60.0, "m/s", "2.2.2: 2 mm/min", Provenance::stated};
inline constexpr Real kTestStrainRate{kGripSpeed.value / kGaugeLength.value, "1/s", "2.2.2", Provenance::inferred};
inline constexpr Count kModulusSpecimens{4, "specimens", "2.2.2", Provenance::stated};
inline constexpr Count kValidToughnessSpecimens{3, "specimens", "2.2.2", Provenance::stated};

// Virtual testers (2.3.1).
inline constexpr Count kElementsPerPixel{2, "elements along one side", "2.3.1, Figure 2-5C", Provenance::stated};
// 200 elements span the 52 mm of a specimen; half a pixel would need another density for a step of 2e-7 s to be stable.
inline constexpr Real kElementSize{260e-6, "m", "2.3.1, Figure 2-5A with 2.2.2", Provenance::chosen};
inline constexpr Count kToughnessUnitsX{5, "units", "2.3.1, Figure 2-5A", Provenance::stated};
inline constexpr Count kToughnessUnitsY{4, "units", "2.3.1, Figure 2-5A", Provenance::stated};
inline constexpr Count kModulusUnitsX{2, "units", "2.3.1, Figure 2-5B", Provenance::stated};
inline constexpr Count kModulusUnitsY{1, "units", "2.3.1, Figure 2-5B", Provenance::stated};
inline constexpr Count kNotchRow{80, "elements from the bottom", "2.3.1", Provenance::stated};
inline constexpr Count kNotchHeight{1, "elements", "2.3.1", Provenance::stated};
inline constexpr Count kNotchElements{40, "elements", "2.2.2: 20 % of the width", Provenance::inferred};
inline constexpr Count kCutElements{30, "elements", "2.2.2: 15 % of the width", Provenance::inferred};
inline constexpr Real kCutAngle{60.0, "degrees", "2.2.2", Provenance::chosen};
inline constexpr Count kQuadraturePoints{4, "points per element", "2.3.1", Provenance::stated};
inline constexpr Real kSimulatedStrainRate{20.0, "1/s", "2.3.1", Provenance::stated};
inline constexpr Real kTimeStep{2e-7, "s", "2.3.1: strain 0.02 in 1.62e8 steps at 2 mm/min", Provenance::inferred};
inline constexpr Real kDensity{1150.0, "kg/m3", "2.3.1: one mass for all nodes; value of printed acrylics",
                               Provenance::chosen};
inline constexpr Real kStrainLimit{0.3, "1", "2.3.1", Provenance::stated};
inline constexpr Real kStressDropLimit{0.2, "of the peak stress", "2.3.1", Provenance::stated};
inline constexpr Real kSoftStrainLimit{2.0, "1", "2.3.1: the soft material's strain is unlimited", Provenance::chosen};
inline constexpr Count kStepLimit{400000, "steps", "2.3.1", Provenance::chosen};
inline constexpr Real kModulusStrain{1e-4, "1", "2.3.1", Provenance::stated};
inline constexpr Real kModulusTimeStep{1e-7, "s", "2.3.1, Eq. 2.5", Provenance::stated};
inline constexpr Count kModulusSteps{10000, "steps", "2.3.1", Provenance::stated};

// System identification (2.3.2).
inline constexpr Real kNearFront{0.2, "normalised distance", "Eq. 2.9", Provenance::stated};
inline constexpr Real kFarFromFront{0.6, "normalised distance", "Eq. 2.9", Provenance::stated};
inline constexpr Real kFarWeight{0.2, "1", "Eq. 2.9", Provenance::stated};
inline constexpr Real kDensitySpread{200.0, "1", "Eq. 2.10, gamma_d", Provenance::stated};
inline constexpr Real kDensityThreshold{2.0, "1", "Eq. 2.11, rho_0", Provenance::stated};
inline constexpr Real kCurveWeight{1.0, "1", "Eq. 2.8, lambda", Provenance::stated};
inline constexpr Count kCalibrationIterations{200, "iterations", "2.3.2", Provenance::stated};
inline constexpr Count kCalibrationBatch{3, "evaluations", "2.3.2", Provenance::stated};
inline constexpr Count kCalibrationSeeds{5, "repetitions", "2.3.2", Provenance::stated};

// Gamut search (2.3.3).
inline constexpr Count kSearchStart{10, "samples", "2.3.3", Provenance::stated};
inline constexpr Count kSearchBatch{10, "samples per iteration", "2.3.3", Provenance::stated};
inline constexpr Count kSearchIterations{500, "iterations", "2.3.3", Provenance::stated};
inline constexpr Count kSearchBudget{5000, "simulations", "2.3.3", Provenance::stated};
inline constexpr Count kSurrogateGenerations{200, "generations", "2.3.3", Provenance::stated};
inline constexpr Count kSurrogatePopulation{100, "patterns", "2.3.3", Provenance::stated};
inline constexpr Count kToughnessResidualBlocks{5, "blocks", "2.3.3, Figure 2-10", Provenance::stated};
inline constexpr Count kModulusResidualBlocks{2, "blocks", "2.3.3, Figure 2-10", Provenance::stated};
inline constexpr Count kToughnessEpochs{300, "epochs", "2.3.3", Provenance::stated};
inline constexpr Count kModulusEpochs{100, "epochs", "2.3.3", Provenance::stated};
inline constexpr Real kLearningRate{1e-3, "1", "2.3.3", Provenance::stated};
inline constexpr Real kToughnessWeightDecay{1e-2, "1", "2.3.3", Provenance::stated};
inline constexpr Real kModulusWeightDecay{1e-6, "1", "2.3.3", Provenance::stated};
inline constexpr Count kTrainingBatch{2048, "samples", "2.3.3", Provenance::stated};
inline constexpr Real kPixelMutation{0.86, "probability", "2.3.3", Provenance::stated};
inline constexpr Real kLineMutation{0.11, "probability", "2.3.3", Provenance::stated};
inline constexpr Real kSquareMutation{0.03, "probability", "2.3.3", Provenance::stated};

// Selection of validation samples (2.3.4).
inline constexpr Count kBoundaryRanks{3, "ranks of non-dominated sorting", "2.3.4", Provenance::stated};
inline constexpr Real kBinAngleThreshold{5.0, "degrees", "Eq. 2.13", Provenance::stated};
inline constexpr Count kBeamSize{100, "selections", "2.3.4", Provenance::stated};

// Families (2.4).
inline constexpr Real kOtherFamilyWeight{0.1, "1", "2.4.1", Provenance::stated};
inline constexpr Count kFamilyRadius{16, "pixels", "2.4.1", Provenance::stated};
inline constexpr Count kDenseSamplingAttempts{300000, "mutations per iteration", "2.4.1", Provenance::stated};

}  // namespace nacre::thesis

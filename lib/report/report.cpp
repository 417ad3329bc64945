#include "report/report.hpp"

#include "report/page.hpp"
#include "report/report_best.hpp"
#include "report/report_designs.hpp"
#include "report/report_diagnosis.hpp"
#include "report/report_errors.hpp"
#include "report/report_figures.hpp"
#include "report/report_rounds.hpp"
#include "report/report_standing.hpp"

namespace nacre::report {

std::string render_report(const run::RunRecord& run, const std::string& run_id) {
  return render_page({.title = run_id + " – nacre",
                      .eyebrow = "nacre, report of a run",
                      .heading = run_id,
                      .content = best_design(run) + standing_sentences(run)},
                     {best_exhibit(run), gamut_exhibit(run), round_exhibit(run), error_exhibit(run),
                      proposal_exhibit(run), curve_exhibit(run), diagnosis_exhibit(run), specimen_exhibit(run)});
}

std::string render_report(run::Run& run, const std::string& run_id) {
  return render_report(run.record_with_gamuts(shown_rounds(*run.record())), run_id);
}

}  // namespace nacre::report

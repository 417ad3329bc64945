// Part of the page's fields (page_fields.hpp): the interfaces of all that the page is sent.

#include "dashboard/design_check.hpp"
#include "dashboard/design_view.hpp"
#include "dashboard/diagnosis_view.hpp"
#include "dashboard/families_view.hpp"
#include "dashboard/laboratory_view.hpp"
#include "dashboard/mechanisms_view.hpp"
#include "dashboard/next_view.hpp"
#include "dashboard/nodes_view.hpp"
#include "dashboard/notes.hpp"
#include "dashboard/page_fields.hpp"
#include "dashboard/print_jobs.hpp"
#include "dashboard/rounds_view.hpp"
#include "dashboard/run_view.hpp"
#include "dashboard/runs_view.hpp"
#include "dashboard/specimen_view.hpp"

namespace nacre::dashboard {

std::string page_types() {
  PageTypes types;
  types.type_of<RunsRow>();
  types.type_of<RunRow>();
  types.type_of<LiveRow>();
  types.type_of<RoundsRow>();
  types.type_of<DesignRow>();
  types.type_of<DesignCheckRow>();
  types.type_of<MechanismsRow>();
  types.type_of<LaboratoryRow>();
  types.type_of<NextRoundRow>();
  types.type_of<SpecimenStoryRow>();
  types.type_of<NotesRow>();
  types.type_of<PrintJobsRow>();
  types.type_of<DiagnosisRow>();
  types.type_of<FamiliesRow>();
  return "// The server's responses, SI units (docs/FORMATS.md, \"Dashboard\"). Written by nacre_page_types from the "
         "tables of\n"
         "// fields in lib/dashboard: not to be edited.\n" +
         types.text();
}

}  // namespace nacre::dashboard

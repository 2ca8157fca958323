#pragma once

#include "app/gui/jobs/ExportJob.h"

namespace palp {

class DeformationPage;
class Workbench;

/// Why the cut cannot be exported now, in a sentence; empty where it can.
QString cutProblem(Workbench& workbench, const DeformationPage& page);

/// The coloured field in the cut as it is shown, under lines that say load, design and whether they still hold.
ExportJob::Making cutMaking(Workbench& workbench, const DeformationPage& page);

} // namespace palp

#pragma once

#include "app/study/paper/PaperProtocol.h"
#include "app/study/paper/PaperReport.h"
#include "app/study/touch/Touch.h"
#include "io/FilesTogether.h"

#include <stop_token>
#include <vector>

namespace palp {

/// The load of Figs. 4 and 7: the paper has "a 3-D force on the first area" without a number; this is ours.
LoadCase paperFigureLoad();

/// Table 1 and Fig. 12 as charts, Figs. 4, 6 and 7 from the touch (advanced to the displacements), Figs. 8-11 and 13-16
/// from the traces of the first area, as PNG files among those of the report. Throws Cancelled between two pictures.
std::vector<ReportPicture> drawPaperFigures(const ProtocolResult& result, const Touch& touch, FilesTogether& files,
                                            const std::stop_token& stop = {});

} // namespace palp

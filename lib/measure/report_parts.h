/*
 * report_parts.h -- what the report of a frame says of a surface and a cloud, below their columns.
 *
 * Private to this room.
 */
#ifndef MR_MEASURE_REPORT_PARTS_H
#define MR_MEASURE_REPORT_PARTS_H

#include "measure/report.h"

/* json: members of an object, with a comma before each; else lines. */
void mr_report_surface(mr_text *t, const mr_surface_figures *s, bool json);
void mr_report_cloud(mr_text *t, const mr_cloud_figures *c, bool json);

#endif

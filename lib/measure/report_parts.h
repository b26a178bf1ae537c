/*
 * report_parts.h -- what the report of a frame says of a surface and a cloud, below their columns.
 *
 * Private to this room.
 */
#ifndef MR_MEASURE_REPORT_PARTS_H
#define MR_MEASURE_REPORT_PARTS_H

#include "measure/report.h"

/* intersections: whether they were looked for. */
void mr_report_surface_text(mr_text *t, const mr_surface_figures *s, bool intersections);
void mr_report_cloud_text(mr_text *t, const mr_cloud_figures *c);

/* Members of an object, with a comma before each. */
void mr_report_surface_json(mr_text *t, const mr_surface_figures *s, bool intersections);
void mr_report_cloud_json(mr_text *t, const mr_cloud_figures *c);

#endif

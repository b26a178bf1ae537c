/* tool.h -- what the tools share, and what commands ask of them besides mr.h. */
#ifndef MR_TOOL_TOOL_H
#define MR_TOOL_TOOL_H

#include "compact/packed.h"
#include "edit/select.h"
#include "mesh/layers.h"

/* Welds, stitches, repairs and turns the layer, as the options ask; one finding lists the repairs and the
 * remaining flaws.  unit: of o->weld. */
mr_status mr_layer_mend(
    mr_ctx *ctx, mr_frame *f, const char *layer, const mr_import_opts *o, double unit) MR_WARN_UNUSED;

/* True where lines along the normals meet triangles, not points.  layer: NULL: points, else mesh. */
bool mr_sample_meets_faces(const mr_frame *f, const char *layer);

/* Reports MR_STALE, of keys, where control has moved and `from`, which is sampled, has not followed. */
mr_status mr_sample_report_move(mr_ctx *ctx, mr_frame *f, const char *from);

/* mr_select_frame and mr_crop_frame, which frees the kept data, for rules that were parsed before. */
mr_status mr_select_by(
    mr_ctx *ctx, mr_frame *f, const mr_selection *s, const mr_select_opts *opts, mr_select_result *result);
mr_status
mr_crop_by(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_selection *s, mr_crop_result *result);

/* mr_pack_frame, for one who keeps what does not go along: where the control mesh was, too. */
mr_status
mr_pack_in_place(mr_ctx *ctx, mr_frame *f, double error, mr_packed_bytes *file, mr_control_order *order);

/* MR_EUSAGE where options of mr_solve_frame contradict each other. */
mr_status mr_solve_check(mr_ctx *ctx, const mr_solve_opts *opts);

#endif

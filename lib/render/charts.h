/* charts.h -- texture coordinates for any surface.  The faces of a chart look within 60 degrees of the
 * direction from where it is seen, in parallel projection, which so stretches nothing by more than twice. */
#ifndef MR_RENDER_CHARTS_H
#define MR_RENDER_CHARTS_H

#include "mesh/mesh.h"

/* Lays the faces out in `side` by `side` texels, with `gutter` around each chart.  uv: 6 nf, of the corners,
 * in the arena.  MR_ERANGE where there is no room. */
mr_status mr_charts(
    mr_ctx *ctx, const mr_mesh *m, size_t side, size_t gutter, double **uv, size_t *count) MR_WARN_UNUSED;

#endif

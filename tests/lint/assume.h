/* What clang's analyser is told, which sees one file at a time: who fails returns that failure. */
#include "formats/scan.h"
#include "mesh/layers.h"

#define mr_fail(ctx, status, ...)   (mr_fail((ctx), (status), __VA_ARGS__), (status))
#define mr_scan_fail(t, where, ...) (mr_scan_fail((t), (where), __VA_ARGS__), MR_EFORMAT)
#define mr_layer_missing(...)       (mr_layer_missing(__VA_ARGS__), MR_EMISSING)

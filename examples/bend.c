/*
 * bend -- a model, bent as a whole, its fine detail kept: the first edit of the README without a pipe.
 *
 *	cc bend.c $(pkg-config --cflags --libs mr) -o bend
 *	./bend model.obj bent.obj
 */
#include <mr.h>

#include <stdio.h>

/* Base, regions, detail: what is done once for a model. */
static mr_status
prepare(mr_ctx *ctx, mr_frame *f)
{
	static const mr_rule rules[] = {
		{ MR_REGION_FREE, "all" },
		{ MR_REGION_FIXED, "below:y,0.5" },
		{ MR_REGION_HANDLE + 1, "above:y,0.85" },
	};
	mr_status status = mr_smooth_frame(ctx, f, NULL, NULL);

	if (status == MR_OK)
		status = mr_remesh_frame(ctx, f, NULL, NULL);
	if (status == MR_OK)
		status = mr_select_frame(ctx, f, rules, sizeof rules / sizeof *rules, NULL, NULL);
	if (status == MR_OK)
		status = mr_solve_frame(ctx, f, NULL, NULL, NULL);
	if (status == MR_OK)
		status = mr_encode_frame(ctx, f, NULL);
	return status;
}

/* Turns handle 1 about the z axis. */
static mr_status
bend(mr_ctx *ctx, mr_frame *f, double degrees)
{
	mr_pose pose = MR_POSE_REST;
	mr_status status;

	pose.degrees = degrees;
	status = mr_pose_frame(ctx, f, NULL, 1, &pose);
	if (status == MR_OK)
		status = mr_solve_frame(ctx, f, NULL, NULL, NULL);
	if (status == MR_OK)
		status = mr_decode_frame(ctx, f, NULL, NULL);
	return status;
}

int
main(int argc, char **argv)
{
	mr_ctx *ctx = mr_ctx_new(0);
	mr_frame *f;
	bool good;

	if (argc != 3 || !ctx) {
		fprintf(stderr, "usage: bend MODEL OUT\n");
		return 2;
	}
	good = mr_import(ctx, argv[1], NULL, &f, NULL) == MR_OK && prepare(ctx, f) == MR_OK &&
	       bend(ctx, f, 30) == MR_OK && mr_export(ctx, f, NULL, argv[2], NULL) == MR_OK;
	if (!good)
		fprintf(stderr, "bend: %s\n", mr_error(ctx));
	mr_ctx_delete(ctx);
	return good ? 0 : 1;
}

/* Bodies in the reference frame, as a part of a run. */
#include "mesh/mesh_part.h"
#include "base/memory.h"
#include "run/part.h"

static void frame_free_all(struct run *e)
{
    struct reference_frame *f = e->frame;
    memory_free(f->elastic), memory_free(f->coarse), memory_free(f->room), memory_free(f->choice);
    levels_free(&f->levels), mesh_free(&f->mesh), hollow_free(&f->hollow), memory_free(f->ring);
    frame_hollow_points_free(e);
}

const struct part part_frame = {PART(frame, reference_frame), .free = frame_free_all};

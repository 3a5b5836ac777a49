/* Cracks, as a part of a run. */
#include "fracture/fracture_part.h"
#include "base/memory.h"
#include "coupling/coupling_part.h"
#include "run/part.h"

static void fracture_free_all(struct run *e)
{
    struct fracture_state *f = e->fracture;
    tips_free(&f->tips);
    for (int k = 0; f->growth && k < e->scene->growths; k++) growth_free(&f->growth[k]);
    memory_free(f->growth);
}

void cracks_notches(struct run *e)
{
    if (e->coupling->notches.lost) tips_before(&e->fracture->tips, e->coupling->notches.lost);
}

bool cracks_fade(const struct run *e)
{
    bool fades = false;
    for (int k = 0; k < e->scene->growths; k++) fades |= e->fracture->growth[k].n > 0;
    return fades;
}

static status fracture_state_of(struct run *e, struct archive *a)
{
    TRY(tips_archive(&e->fracture->tips, a));
    for (int k = 0; k < e->scene->growths; k++) TRY(growth_archive(&e->fracture->growth[k], k, a));
    return OK;
}

const struct part part_fracture = {PART(fracture, fracture_state), .free = fracture_free_all,
                                   .state = fracture_state_of};

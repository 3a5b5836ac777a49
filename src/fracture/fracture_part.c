/* Registers crack tips and growing cracks in the table of the parts of a run (engine/parts.c). */
#include "fracture/fracture_part.h"
#include "base/memory.h"
#include "run/part.h"

static void fracture_free_all(struct run *run)
{
    struct fracture_state *f = run->fracture;
    tips_free(&f->tips);
    for (int k = 0; k < f->growths; k++) growing_crack_free(&f->growth[k]);
    memory_free(f->growth);
}

bool any_growing_crack_weakens_bonds_gradually(const struct fracture_state *f)
{
    bool fades = false;
    for (int k = 0; k < f->growths; k++) fades |= f->growth[k].n > 0;
    return fades;
}

static status fracture_state_of(struct run *run, struct archive *a)
{
    TRY(tips_save_or_load(&run->fracture->tips, a));
    for (int k = 0; k < run->fracture->growths; k++) TRY(growing_crack_save_or_load(&run->fracture->growth[k], k, a));
    return OK;
}

const struct part part_fracture = {PART(fracture, fracture_state), .free = fracture_free_all,
                                   .state = fracture_state_of};

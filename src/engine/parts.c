/* Lists the parts of a run (contact, mesh, probes and so on) in a table. Its order is that of the columns in
 * history.csv and of the state in checkpoints. */
#include <string.h>

#include "base/memory.h"
#include "run/part.h"

extern const struct part part_grid, part_frame, part_rigid, part_contact, part_coupling, part_fracture, part_solver,
    part_diagnostics, part_probing, part_damping, part_viscosity, part_stability, part_report, part_statics;

static const struct part *const parts[] = {&part_grid,        &part_frame,    &part_rigid,   &part_contact,
                                           &part_coupling,    &part_fracture, &part_solver,  &part_statics,
                                           &part_diagnostics, &part_probing,  &part_damping, &part_viscosity,
                                           &part_stability,   &part_report,   NULL};

/* Returns the address of the pointer in the run to the structure of the part p (contact, mesh, probes and so on). p->at
 * is the offset of this pointer in struct run. */
static void **part_place(struct run *run, const struct part *p) { return (void **)((char *)run + p->at); }

void run_components_allocate(struct run *run)
{
    run->parts = parts;
    for (size_t k = 0; k < COUNT_OF(parts) - 1; k++)
        *part_place(run, parts[k]) = memory_new(parts[k]->name, 1, parts[k]->size);
}

void run_components_free(struct run *run)
{
    for (size_t k = 0; k < COUNT_OF(parts) - 1; k++)
        if (parts[k]->free && *part_place(run, parts[k])) parts[k]->free(run);
    for (size_t k = 0; k < COUNT_OF(parts) - 1; k++) {
        void **place = part_place(run, parts[k]);
        memory_free(*place), *place = NULL;
    }
}

/* Registers the coupling in the table of the parts of a run (engine/parts.c), and writes its results to the summary. */
#include "coupling/coupling_part.h"
#include "base/memory.h"
#include "run/part.h"

static void coupling_free_all(struct run *run)
{
    struct coupling_state *c = run->coupling;
    partial_stress_free(&c->partial), interface_zone_free(&c->zone), notches_free(&c->notches);
    memory_free(c->bonded), memory_free(c->start_region.solid);
}

/* Returns the largest number of times that a single particle of p has reverted to a material point. */
static int reversions_most(const struct particles *p)
{
    int most = 0;
    for (int64_t i = 0; i < p->n; i++) most = p->reversions[i] > most ? p->reversions[i] : most;
    return most;
}

/* Writes the JSON list "notches" to j: for each of the first SAID pre-cracks of n a text that says whether it is a
 * slit, along which nodes of the mesh are doubled, or a line of cut bonds. Writes nothing without pre-cracks. spacing:
 * lattice spacing [m]. */
static void put_notches(struct json *j, const struct notches *n, real spacing)
{
    enum { SAID = 16 };
    char text[256];
    if (n->n == 0) return;
    json_begin_object_or_list(j, "notches", '[');
    for (int k = 0; k < n->n && k < SAID; k++) {
        notch_describe_as_slit_or_cut_bonds(n, k, spacing, text, sizeof text);
        json_write_text(j, NULL, text);
    }
    json_end_object_or_list(j, ']');
}

static void put_conversion(const struct run *run, struct json *j)
{
    const struct conversion *c = &run->coupling->conversion;
    real n = (real)run->part.n_body, start = (real)c->start / n, end = (real)run->part.n_of[KIND_PD] / n;
    json_begin_object_or_list(j, "conversion", '{');
    if (isfinite(c->first_time) && c->events > 0) {
        json_write_real(j, "first_time", c->first_time);
        json_write_point(j, "", c->first_place, run->part.dim);
    }
    json_write_real(j, "pd_share_start", start);
    json_write_real(j, "pd_share_end", end);
    json_write_real(j, "pd_share_max", real_max((real)c->peak / n, real_max(start, end)));
    put_notches(j, &run->coupling->notches, run->scene->spacing);
    if (run->part.low_since) {
        json_write_integer(j, "converted", c->converted);
        json_write_integer(j, "reverted", c->reverted);
        json_write_integer(j, "reversions_most", reversions_most(&run->part));
        json_write_real(j, "reversion_energy", c->reversion_energy);
    }
    json_end_object_or_list(j, '}');
}

/* Saves the state of conversion of the run to the archive a if a->saving, else restores it. The strains of material
 * points with bonds to peridynamic particles are not saved, but recomputed from the mesh on restoring. Returns FAILED
 * if the archive cannot be read or written or lacks the state. */
static status coupling_state_of(struct run *run, struct archive *a)
{
    if (!a->saving)
        bonded_mpm_points_update_cell_strain(&run->coupling->partial, run->frame, &run->part, run->scene->material);
    return conversion_save_or_load(&run->coupling->conversion, a);
}

const struct part part_coupling = {PART(coupling, coupling_state), .free = coupling_free_all, .summary = put_conversion,
                                   .warn = warn_of_bodies_that_penetrate_or_stick_together, .state = coupling_state_of};

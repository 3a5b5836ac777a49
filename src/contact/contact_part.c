/* Registers contact in the table of the parts of a run (engine/parts.c), writes its results to the summary, and checks
 * the overlaps of particles. */
#include "contact/contact_part.h"

#include <math.h>
#include <stdio.h>

#include "contact/contact.h"
#include "rigid/rigid_part.h"
#include "run/part.h"
#include "grid/grid_part.h"
#include "run/say.h"

static void contact_free_all(struct run *run) { contact_free(run->contact); }

/* Writes the JSON object "contact" to j if peridynamic particles (c) or bodies of material points on the grid (mpm) can
 * be in contact: times of first and last contact [s], largest numbers of contacts, work of friction [J] and largest
 * overlap [spacings]. Else writes nothing. */
static void put_contact(const struct contact *c, const struct grid_method *mpm, struct json *j)
{
    const struct grid_contact *g = &mpm->contact;
    if (c->law.between == CONTACT_NONE && mpm->fields < 2) return;
    json_begin_object_or_list(j, "contact", '{');
    json_write_real(j, "began", fmin(c->began, g->began));
    json_write_real(j, "ended", fmax(c->ended, g->ended));
    if (mpm->fields > 1) json_write_integer(j, "nodes_max", g->nodes_most);
    if (c->law.between == CONTACT_NONE) {
        json_end_object_or_list(j, '}');
        return;
    }
    json_write_integer(j, "pairs_max", c->pairs_most);
    json_write_real(j, "friction_work", contact_friction_dissipated_energy(c));
    json_write_real(j, "overlap_max", c->overlap_most / c->law.spacing);
    json_end_object_or_list(j, '}');
}

static status contact_state(struct run *run, struct archive *a)
{
    struct contact *c = run->contact;
    c->marked = scene_has_load_steps(run->scene);
    TRY(contact_save_or_load(c, &run->part, a));
    if (!a->saving && c->made && !c->touch)
        contact_restore_active_particles_after_restart(c, &run->part, &run->bonds, &run->loads);
    return OK;
}

/* Writes the JSON array "rigid" to j: for each rigid body its position and velocity at the present time of `clock`, the
 * largest force on it [N] and the diameter of its contact patch [m]. Writes nothing without rigid bodies. c, p: contact
 * and particles, from which the patches follow. */
static void put_rigid(const struct rigid_set *rigid, const struct contact *c, const struct particles *p,
                      const struct run_clock *clock, struct json *j)
{
    static const char *const velocity[] = {"velocity_x", "velocity_y", "velocity_z"};
    if (rigid->n == 0) return;
    json_begin_object_or_list(j, "rigid", '[');
    for (int k = 0; k < rigid->n; k++) {
        const struct rigid_body *r = &rigid->body[k];
        real v[DIM_MAX];
        rigids_compute_velocity_of_body_at_time(rigid, k, clock->t, clock->dt, v);
        json_begin_object_or_list(j, NULL, '{');
        json_write_text(j, "name", r->name);
        json_write_point(j, "", r->x, r->dim);
        for (int d = 0; d < r->dim; d++) json_write_real(j, velocity[d], v[d]);
        json_write_real(j, "force_max", r->force_most);
        json_write_real(j, "patch", contact_patch_bounding_box_diagonal(c, p, k));
        json_end_object_or_list(j, '}');
    }
    json_end_object_or_list(j, ']');
}

static void put_contact_and_rigid(const struct run *run, struct json *j)
{
    put_contact(run->contact, run->grid, j);
    put_rigid(run->rigid, run->contact, &run->part, &run->clock, j);
}

#define OVERLAP_DOUBTFUL 0.3 /* overlap from which a warning is given [spacings] */
#define OVERLAP_MOST 0.9     /* overlap beyond which particles pass each other [spacings] */

status contact_warn_or_fail_if_overlap_too_large(struct run *run)
{
    const struct contact *c = run->contact;
    const real overlap = c->overlap / run->scene->spacing;
    char text[320];
    if (!(overlap > OVERLAP_DOUBTFUL)) return OK;
    if (overlap > OVERLAP_MOST) {
        const struct particles *p = &run->part;
        const int32_t i = c->deepest;
        return status_set(FAILED,
                          "contact at step %lld, t = %.3g s: particle %d at (%.6g, %.6g, %.6g) m overlaps another one "
                          "by %.2f spacings and is about to pass through it. Check the speeds (wave speed: %.4g m/s), "
                          "or use a larger contact.stiffness (now %.3g) with a smaller time.safety",
                          (long long)run->clock.step, run->clock.t, (int)p->id[i], p->x[0][i],
                          p->dim > 1 ? p->x[1][i] : 0, p->dim > 2 ? p->x[2][i] : 0, overlap, run->tables.wave_speed,
                          run->scene->contact_stiffness);
    }
    if (run->contact->overlap_said) return OK;
    run->contact->overlap_said = true;
    snprintf(text, sizeof text,
             "particles in contact overlap by more than %.1f spacings (contact.overlap_max in the summary), so contact "
             "pressures are wrong; use a larger contact.stiffness",
             OVERLAP_DOUBTFUL);
    warnings_add_and_print(&run->warnings, text);
    return OK;
}

const struct part part_contact = {PART(contact, contact), .free = contact_free_all, .summary = put_contact_and_rigid,
                                  .state = contact_state};

/* Warns where bonds corrected by pd.surface: moments do not have the stiffness of the continuum: in bodies of a few
 * rows of particles, and where the solver of the bond weights has not converged. */
#include <math.h>

#include "engine_internal.h"

/* Largest thickness of a body for which a warning is given [rows of particles]. The force in such bodies is 1.4 to 1.8
 * times that of the continuum; in bodies of 5 rows and more it is 2 to 12 % too large. */
#define ROWS_FEW 3.5
#define ROWS_ENOUGH 5 /* rows of the spacing that is named as a remedy */
#define UNSOLVED 1e-8 /* residual of the bond weights from which on a warning is given; of converged weights: 1e-13 */

/* Adds a warning to *to about body number b of scene s if it is fewer than ROWS_FEW (3 to 4) particles thick along an
 * axis. p: particles. */
static void warn_of_thin(const struct scene *s, const struct particles *p, int b, struct warnings *to)
{
    real low[DIM_MAX], high[DIM_MAX], rows = INFINITY;
    int axis = 0;
    if (!joined_bodies_compute_bounding_box(s, p, b, low, high)) return;
    for (int d = 0; d < s->dim; d++) {
        const real n = scene_particle_count_along_axis_with_mirrors(s, low[d], high[d], d);
        if (n < rows) rows = n, axis = d;
    }
    if (rows > ROWS_FEW) return;
    warnings_add_if_new(
        to,
        "body %s has %.0f row%s of particles along %c, so with pd.surface: moments it carries up to 1.8 times the "
        "force of the continuum in tension and bending. Set particles.spacing: %.3g m (%d rows) for an error of 2 %% "
        "in the plane, 12 %% in space; if this is intended, add accept: [particles]",
        s->body[b].name, rows, rows > 1.5 ? "s" : "", "xyz"[axis], s -> spacing *rows / ROWS_ENOUGH, ROWS_ENOUGH);
}

void run_warn_of_bodies_too_thin_to_correct_faces(const struct scene *s, const struct particles *p,
                                                  const struct surface_correction *weights, struct warnings *warnings)
{
    if (s->surface != SURFACE_MOMENTS || s->method != METHOD_PD || s->dim < 2) return;
    if (weights->residual > UNSOLVED)
        warnings_add_if_new(
            warnings,
            "pd.surface: moments: the weights of bonds near faces have not converged (residual %.2g, required 1e-13): "
            "the stiffness near faces is only partly corrected; use a larger particles.spacing, or pd.surface: volume",
            weights->residual);
    for (int b = 0; b < s->bodies && p->n == p->n_body && !scene_silences_warning(s, ACCEPT_PARTICLES); b++)
        warn_of_thin(s, p, b, warnings);
}

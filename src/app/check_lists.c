/* Reports bodies whose particles come from a list and form no lattice along the axes, and thin parts of such bodies.
 * Weights of bonds are not corrected near their faces, and no solid states the thickness of a part, so that it is
 * measured by counting particles. */
#include <math.h>

#include "check_parts.h"

#define THIN_SHARE 0.05 /* least share of a body's particles in a thin part that is reported */
#define PROBE 0.9       /* [spacings] largest distance of a particle from a position inside the body */
/* LOOKED_AT: approximate number of particles of a body that are examined. LAYERS_MOST: largest number of layers that is
 * counted. */
enum { LOOKED_AT = 1024, LAYERS_MOST = 16 };

/* Returns true if a particle of body number `body` of the run is within PROBE spacings of the point X[dim] [m], so that
 * X counts as inside the body. Also returns true if more than ROOM particles are that near to X. */
static bool body_at(const struct run *run, int body, const real *X)
{
    enum { ROOM = 64 };
    int32_t found[ROOM];
    const int n =
        cells_list_particles_near_point(&run->cells, &run->part, X, PROBE * run->scene->spacing, -1, found, ROOM);
    for (int k = 0; k < n && k < ROOM; k++)
        if (found[k] < run->part.n && run->part.body[found[k]] == body) return true;
    return n > ROOM;
}

/* Returns the thickness of the body at particle i of the run [particles]: the particles are counted along each axis
 * through particle i, up to LAYERS_MOST, and the smallest count is returned. An axis along which the body ends at a
 * plane of symmetry counts as LAYERS_MOST. */
static int layers_at(const struct run *run, int64_t i)
{
    const struct particles *p = &run->part;
    const real spacing = run->scene->spacing;
    int least = LAYERS_MOST;
    for (int d = 0; d < p->dim; d++) {
        int layers = 1;
        for (int side = -1; side <= 1; side += 2) {
            real X[DIM_MAX];
            particle_reference_position(p, i, X);
            for (int k = 1; k < LAYERS_MOST && layers < LAYERS_MOST; k++, layers++) {
                X[d] += side * spacing;
                if (!body_at(run, p->body[i], X)) break;
            }
            for (int m = 0; m < run->source.mirrors; m++)
                if (run->source.mirror[m].axis == d && fabs(X[d] - run->source.mirror[m].at) < spacing)
                    layers = LAYERS_MOST;
        }
        least = layers < least ? layers : least;
    }
    return least;
}

/* Returns a measure of how thin body number `body` of the run is: the smallest number L such that at least the share
 * THIN_SHARE of its particles have L or fewer layers of particles across the body; at most LAYERS_MOST. Tests a sample
 * of about LOOKED_AT particles. */
static int thinnest(const struct run *run, int body)
{
    const struct particles *p = &run->part;
    int64_t count[LAYERS_MOST + 1] = {0}, all = 0, own = 0;
    for (int64_t i = 0; i < p->n; i++) own += p->body[i] == body;
    const int64_t stride = own / LOOKED_AT + 1;
    for (int64_t i = 0, k = 0; i < p->n; i++) {
        if (p->body[i] != body || k++ % stride != 0) continue;
        count[layers_at(run, i)]++, all++;
    }
    int64_t sum = 0;
    for (int layers = 0; layers < LAYERS_MOST; layers++) {
        sum += count[layers];
        if ((real)sum >= THIN_SHARE * (real)all) return layers;
    }
    return LAYERS_MOST;
}

/* Prints advice to `out` for each body of scene s (the input file) that is read from a list of particles not on a
 * lattice along the axes, if the input file has pd.weights: isotropic. These weights of bonds are computed for a
 * lattice along the axes. */
static void print_weight_advice(const struct scene *s, FILE *out)
{
    for (int b = 0; b < s->bodies && s->shells == SHELLS_ISOTROPIC; b++) {
        if (!s->body[b].file || s->body[b].list.lattice || s->body[b].joined != b) continue;
        fprintf(out,
                "accuracy       body %s: the particles of its list are not on a lattice along the axes, which "
                "pd.weights: isotropic assumes (a lattice turned by 45 degrees is 4.7 %% too soft, with pd.weights: "
                "uniform only 2.3 %%); set pd.weights: uniform\n",
                s->body[b].name);
    }
}

void print_stiffness_advice_on_particle_list_bodies(const struct run *run, FILE *out)
{
    const struct scene *s = run->scene;
    if (s->method != METHOD_PD || s->dim == 1 || !(s->spacing > 0)) return;
    print_weight_advice(s, out);
    if (s->surface == SURFACE_MOMENTS) return;
    for (int b = 0; b < s->bodies; b++) {
        if (!s->body[b].file || s->body[b].joined != b) continue;
        const int layers = thinnest(run, b);
        if (layers >= LAYERS_MOST) continue;
        fprintf(out,
                "accuracy       body %s: parts of it (from a particle list) are only %d layers of particles thick, so "
                "with pd.surface: %s their stiffness is off by up to ",
                s->body[b].name, layers, s->surface == SURFACE_VOLUME ? "volume" : "none");
        print_stiffness_error_of_thin_part(s, s->surface, layers, out);
        fprintf(out, "; with pd.surface: moments by ");
        print_stiffness_error_of_thin_part(s, SURFACE_MOMENTS, layers, out);
        fprintf(out, "%s\n",
                s->body[b].list.lattice ? ""
                                        : ", but this needs a list that is a lattice (positions at whole spacings, "
                                          "volumes of spacing cubed or squared)");
    }
}

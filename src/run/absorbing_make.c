/* Impedances of absorbing faces, from the elastic constants of bonds on the lattice, points on the grid and cells of
 * the mesh. */
#include <math.h>

#include "run/make.h"
#include "base/memory.h"

/* Returns the wave impedances of material m at an absorbing face [kg/(m^2 s)]: normal sqrt(rho c11) and tangential
 * sqrt(rho shear). c11, shear: elastic constants [Pa]. */
static struct impedance impedance_of(const struct material *m, real c11, real shear)
{
    return (struct impedance){sqrt(m->density * c11), sqrt(m->density * shear)};
}

/* Returns the wave impedances of material m with the elastic constants that bonds on the lattice give it: for
 * bond-based models sums over the neighbourhood (all neighbours of a particle), for state-based models the constants of
 * the material. source: neighbourhood; scene: dimension. */
static struct impedance impedance_lattice(const struct bond_source *source, const struct scene *scene,
                                          const struct material *m)
{
    real c11, c12;
    family_compute_cubic_elastic_constants(&source->family, m, &c11, &c12);
    return impedance_of(m, c11, scene->dim > 1 ? c12 : 0);
}

struct impedance *absorbing_boundary_impedances(const struct scene *s, const struct bond_source *source)
{
    bool any = false;
    for (int b = 0; b < s->boundaries; b++) any = any || s->boundary[b].kind == BOUNDARY_ABSORBING;
    if (!any || scene_is_single_equilibrium(s)) return NULL;
    struct impedance *z = NEW("engine.impedance", (int64_t)MOVERS * s->materials, struct impedance);
    for (int by = 0; by < MOVERS; by++)
        for (int k = 0; k < s->materials; k++) {
            const struct material *m = &s->material[k];
            const bool lattice =
                by == MOVED_BY_BONDS ? s->model == MODEL_BOND : by == MOVED_BY_MESH && s->lattice_constants;
            z[by * s->materials + k] = lattice ? impedance_lattice(source, s, m) : impedance_of(m, m->c11, m->shear);
        }
    return z;
}

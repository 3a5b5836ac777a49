/* Computes the work of separation of a lattice, which relates critical stretch and energy release rate.
 *
 * Both halves of a full lattice move apart by the opening D, normal to a plane between two layers at distance
 * h. A bond across the plane, of length r and with the component z normal to the plane, has the extension e =
 * D z/r and the relative displacement |eta| = D; it breaks at D = s_c r^2/z. With the energy density W of a
 * particle (kernels/pd/state_laws.h; A, B: constants; w, Q: weight of a bond, weighted volume; no rotation,
 * since the halves stay straight) the work per area is
 *     G = 2 sum_layers h int (dW/dD) dD = K s_c^2,   W = [A S^2 + B/Q sum w |eta|^2]/2,   S = sum w r e/Q
 * exactly, as W is quadratic in D between two breaks; models without rotations have e^2 instead of |eta|^2.
 * Bonds that resist eta store more energy before they reach s_c, the more oblique they are: G of the model
 * with rotations grows with the logarithm of horizon over spacing and has no continuum limit. Counting
 * crossing bonds that are all stretched by s_c (Madenci & Oterkus 2014, right for e) underestimates it by
 * factors of 1.7 in 2D and 2.7 in 3D at a horizon of 3.015 spacings, omega = delta/r. */
#include <math.h>
#include <stdlib.h>

#include "bonds/bonds.h"
#include "bonds/softening_work.h"
#include "base/memory.h"

/* A bond across the plane on which two halves of a lattice separate. breaks: opening at which it breaks, divided by
 * the critical stretch [m]; weighted: its part of the weighted volume Q; sum, energy: its parts of sum w r e and sum
 * w |eta|^2 at unit opening. */
struct crossing {
    real breaks, weighted, sum, energy;
};

/* Compares two bonds across a plane (struct crossing) for qsort: by the opening of the plane at which they break, the
 * last to break first. Returns -1, 0 or 1. a, b: struct crossing. */
static int later(const void *a, const void *b)
{
    const struct crossing *x = a, *y = b;
    return (x->breaks < y->breaks) - (x->breaks > y->breaks);
}

/* Lists in c the bonds that cross a plane from one particle of a full lattice at `height` [m] above the plane. f:
 * neighbourhood of a particle; c must have room for all neighbours in a full family. Returns the number of bonds. */
static int crossings(const struct family *f, real height, struct crossing *c)
{
    const int dim = space_dim(f->space), reach = (int)ceil(f->cutoff / f->spacing), depth = dim > 2 ? reach : 0;
    int n = 0;
    for (int z = 1; z <= reach; z++)
        for (int y = -depth; y <= depth; y++)
            for (int x = -reach; x <= reach; x++) {
                real xi[DIM_MAX] = {x * f->spacing, z * f->spacing, y * f->spacing};
                real r = sqrt(dot(xi, xi, dim));
                if (xi[1] < height || r > f->cutoff) continue;
                real w = family_bond_weight(f, xi, r);
                c[n++] = (struct crossing){square(r) / xi[1], w * square(r), w * xi[1], w};
            }
    return n;
}

/* Returns the work per volume [Pa] that separates all bonds of a layer of particles at `height` [m] above a plane, if
 * the critical stretch is 1. It is the integral of the energy density of a particle over the opening of the plane,
 * summed from the last bond that breaks back to the first. f: neighbourhood; m: constants of the state-based law;
 * rotates: true for the model with particle rotations; local: true if the weighted volume Q is summed over the intact
 * bonds only; c: working memory for the bonds that cross the plane. */
static real layer_work(const struct state_modulus *m, const struct family *f, real height, bool rotates, bool local,
                       struct crossing *c)
{
    const int n = crossings(f, height, c);
    real Q = f->weighted, sum = 0, energy = 0, work = 0;
    array_sort(c, n, sizeof *c, later);
    for (int k = 0; k < n && local; k++) Q -= c[k].weighted;
    for (int k = 0; k < n; k++) {
        const real before = k + 1 < n ? c[k + 1].breaks : 0;
        if (local) Q += c[k].weighted;
        sum += c[k].sum, energy += rotates ? c[k].energy : c[k].sum / c[k].breaks;
        work += 0.5 * (m->A * square(sum / Q) + m->B / Q * energy) * (square(c[k].breaks) - square(before));
    }
    return work;
}

real family_fracture_energy_over_stretch_squared(const struct family *f, const struct state_modulus *m,
                                                 bool particles_rotate, bool intact_bonds_only)
{
    const int reach = (int)ceil(f->cutoff / f->spacing);
    const int64_t room = (int64_t)reach * (2 * reach + 1) * (space_dim(f->space) > 2 ? 2 * reach + 1 : 1);
    struct crossing *c = NEW("separation.crossing", room, struct crossing);
    real work = 0;
    for (int layer = 0; layer < reach; layer++)
        work += layer_work(m, f, (layer + 0.5) * f->spacing, particles_rotate, intact_bonds_only, c);
    memory_free(c);
    return 2 * f->spacing * work;
}

enum { OPENINGS = 1000 }; /* steps of the quadrature over the opening; 4000 give 1e-5 less */

/* Returns the work per volume [Pa] that separates all bonds of a layer of particles at `height` [m] above a plane, if
 * bonds soften: the integral of dW/dD at constant damage over the opening D of the plane. The energy density of a
 * particle is W = D^2/2 [A (sum q w z/Q)^2 + B/Q sum q w |e/D|^2]. A bond across the plane has the stretch D z/r^2, and
 * q is the share of its stiffness that remains at this stretch. f: neighbourhood; m: constants A, B of the state-based
 * law; rotates: true for a model with particle rotations; curve, range: softening curve and the stretches between which
 * bonds soften; c: working memory for the bonds that cross the plane. */
static real layer_softening_work(const struct family *f, real height, const struct state_modulus *m, bool rotates,
                                 const struct softening_curve *curve, struct softening_range range, struct crossing *c)
{
    const int n = crossings(f, height, c);
    real last = 0, before = 0, work = 0;
    for (int k = 0; k < n; k++) last = real_max(last, range.end * c[k].breaks);
    for (int step = 1; step <= OPENINGS; step++) {
        const real opening = last * step / OPENINGS;
        real sum = 0, energy = 0;
        for (int k = 0; k < n; k++) {
            const real s = opening / c[k].breaks;
            const real kept = s <= range.onset ? 1
                              : s >= range.end
                                  ? 0
                                  : softening_remaining_stiffness_fraction(curve, range.onset, range.end, s);
            sum += kept * c[k].sum, energy += kept * (rotates ? c[k].energy : c[k].sum / c[k].breaks);
        }
        const real traction = opening * (m->A * square(sum / f->weighted) + m->B / f->weighted * energy);
        work += 0.5 * (before + traction) * last / OPENINGS;
        before = traction;
    }
    return work;
}

real family_fracture_energy_of_softening_bonds(const struct family *f, const struct state_modulus *m,
                                               bool particles_rotate, const struct softening_curve *curve,
                                               struct softening_range softening_stretches)
{
    const int reach = (int)ceil(f->cutoff / f->spacing);
    const int64_t room = (int64_t)reach * (2 * reach + 1) * (space_dim(f->space) > 2 ? 2 * reach + 1 : 1);
    struct crossing *c = NEW("separation.crossing", room, struct crossing);
    real work = 0;
    for (int layer = 0; layer < reach; layer++)
        work += layer_softening_work(f, (layer + 0.5) * f->spacing, m, particles_rotate, curve, softening_stretches, c);
    memory_free(c);
    return 2 * f->spacing * work;
}

/* Returns the energy per area of all bonds across a plane at the critical stretch of material m [J/m^2], on the lattice
 * with the neighbourhood f. A bond whose component normal to the plane is n spacings counts n times: n parallel bonds
 * per lattice cell of the plane cross it. */
real family_energy_release_rate_at_critical_stretch(const struct family *f, const struct material *m)
{
    const int dim = space_dim(f->space), reach = (int)ceil(f->cutoff / f->spacing);
    const int width = dim > 1 ? reach : 0, depth = dim > 2 ? reach : 0;
    real sum = 0;
    for (int x = 1; x <= reach; x++)
        for (int y = -width; y <= width; y++)
            for (int z = -depth; z <= depth; z++) {
                const real xi[DIM_MAX] = {x * f->spacing, y * f->spacing, z * f->spacing}, r = sqrt(dot(xi, xi, dim));
                if (r <= f->cutoff) sum += x * family_bond_weight(f, xi, r) * r;
            }
    const real energy = 0.5 * family_micro_modulus(f, m) * square(m->critical_stretch) * square(f->cell_volume) * sum;
    return energy * f->spacing / f->cell_volume;
}

/* Advances eight peridynamic particles by a leap-frog step, for pd_move.c and for the loops of bond forces
 * (sweep.h). */
#ifndef CLEAVE_KERNELS_PD_MOVE
#define CLEAVE_KERNELS_PD_MOVE

#include "kernels/divergence.h"
#include "kernels/kernels.h"

/* Returns a bit for each of the particles list[0] .. list[n - 1] of p, n <= 8: bit l is set if particle list[l] is
 * moved now, i.e. if it is peridynamic, not moved by the grid, and loaded[i] is 0 for its index i. loaded: [particles]
 * not 0 for particles that are moved later, after the loads are applied; NULL: none. */
static ALWAYS_INLINE unsigned pd_particles_to_move_now_bits(const struct particles *p, const int32_t *list, int n,
                                                            const uint8_t *loaded)
{
    const int32_t first = list[0];
    unsigned bits = 0;
    if (n == LANES && list_is_consecutive(list) && eight_bytes_as_word(p->kind + first) == EIGHT_TIMES(KIND_PD) &&
        !(eight_bytes_as_word(p->flag + first) & EIGHT_TIMES(FLAG_GRID_COUPLED)) &&
        !(loaded && eight_bytes_as_word(loaded + first)))
        return UINT8_MAX;
    for (int l = 0; l < n; l++)
        bits |= (unsigned)(!particle_is_moved_by_grid_or_mesh_nodes(p, list[l]) && !(loaded && loaded[list[l]])) << l;
    return bits;
}

/* Stores a[l] in to[list[l]] for those of eight particles list[l], l = 0 to 7, whose bit l is set in `movers`.
 * consecutive: true if all bits are set and the particle numbers are consecutive. */
static ALWAYS_INLINE void pd_store_values_of_selected_particles(real *to, const int32_t *list, bool consecutive,
                                                                unsigned movers, lanes a)
{
    if (consecutive)
        lanes_store(to + list[0], a);
    else
        for (int l = 0; l < WIDE; l++)
            if (movers >> l & 1) to[list[l]] = a[l];
}

/* Advances the eight particles list[0] .. list[7] of p by a leap-frog step, v += dt_velocity f/m, x += dt v (Zeng et
 * al. 2022, eq. 21). Only the particles whose bit is set in `movers` are changed. consecutive: true if all bits are set
 * and the particle numbers are consecutive; m: step sizes, and the speed above which a particle has diverged. Returns
 * true if one of the moved particles has diverged. */
static ALWAYS_INLINE bool pd_leapfrog_step_and_check_divergence(struct particles *p, const int32_t *list,
                                                                unsigned movers, const struct pd_motion *m,
                                                                const int dim, const bool consecutive)
{
    const int32_t first = consecutive ? list[0] : -1;
    const lanes inverse_mass = m->dt_velocity / lanes_load_or_gather(p->mass, first, list);
    lanes speed2 = lanes_broadcast(0), place = lanes_broadcast(0), v[DIM_MAX], x[DIM_MAX];
    for (int d = 0; d < dim; d++) {
        v[d] = lanes_load_or_gather(p->v[d], first, list) + lanes_load_or_gather(p->f[d], first, list) * inverse_mass;
        x[d] = lanes_load_or_gather(p->x[d], first, list) + v[d] * m->dt;
        speed2 += v[d] * v[d], place += lanes_absolute(x[d]);
    }
    for (int d = 0; d < dim; d++) {
        pd_store_values_of_selected_particles(p->v[d], list, consecutive, movers, v[d]);
        pd_store_values_of_selected_particles(p->x[d], list, consecutive, movers, x[d]);
    }
    const lanes_mask diverged = lanes_mask_of_diverged_particles(speed2, place, square(m->fastest));
    bool any = consecutive && lanes_mask_any(diverged);
    for (int l = 0; l < WIDE && !consecutive; l++) any |= (movers >> l & 1) && diverged[l];
    return any;
}

/* Advances by a leap-frog step those of the particles list[0] .. list[n - 1] of p, n <= 8, that are peridynamic, not
 * moved by the grid and not marked in `loaded`. list: eight entries, ascending, aligned to 32 bytes; m: step sizes;
 * loaded: [particles] not 0 for particles that are moved later; NULL: none. Returns true if one of the moved particles
 * has diverged. */
static ALWAYS_INLINE bool pd_advance_up_to_eight_particles(struct particles *p, const int32_t *list, int n,
                                                           const uint8_t *loaded, const struct pd_motion *m,
                                                           const int dim)
{
    const unsigned movers = pd_particles_to_move_now_bits(p, list, n, loaded);
    if (movers == 0) return false;
    const bool consecutive = movers == UINT8_MAX && list_is_consecutive(list);
    bool diverged = false;
    for (int part = 0; part < LANES; part += WIDE)
        diverged |= consecutive ? pd_leapfrog_step_and_check_divergence(p, list + part, movers, m, dim, true)
                                : pd_leapfrog_step_and_check_divergence(p, list + part, movers >> part, m, dim, false);
    return diverged;
}

#endif

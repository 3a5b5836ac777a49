/* The contract of the hot loops: what each reads, writes and costs. Every kernel has one body and many instances
 * (variants.h). Bond kernels have a plain reference in tests/support/reference.h, those of grid and mesh in their
 * tests. Kernels cannot fail and use no files, scenes, memory or clocks. */
#ifndef CLEAVE_KERNELS_KERNELS
#define CLEAVE_KERNELS_KERNELS

#include "bonds/bonds.h"
#include "data/grid.h"
#include "kernels/simd/kernel.h"
#include "data/mesh.h"
#include "data/particles.h"
#include "data/transfer_order.h"

enum shape { SHAPE_LINEAR, SHAPE_GIMP, SHAPE_CPGIMP, SHAPE_QUADRATIC, SHAPE_CUBIC, SHAPES };
enum transfer { TRANSFER_FLIP, TRANSFER_APIC, TRANSFERS };
enum pd_model {
    PD_BOND,         /* elastic, brittle                                         */
    PD_BOND_PLASTIC, /* the same with yielding: needs the plastic arrays of bonds */
    PD_OSPD,         /* ordinary state-based: needs the state arrays of bonds    */
    PD_MOSPD,        /* with effective displacements, free of rotation           */
    PD_MODELS
};

/* Constants of a material for the stress update, and its conversion trigger. */
struct elastic {
    real c11, c12, shear;  /* [Pa] */
    real trigger;          /* sigma_1 that marks a point for conversion; INFINITY; where strength
                            * scatters that of the weakest point [Pa] */
    real trigger_mean;     /* that of a point of strength 1; the same where nothing scatters [Pa] */
    real yield, hardening; /* sigma_y, 0: never yields; H (plastic.h) [Pa] */
    real poisson;          /* of plane strain, where the material yields [1] */
    enum space space;
};

/* sigma_1 that marks a point of this material for conversion [Pa]. */
static inline real point_trigger(const struct elastic *m, const struct particles *p, int64_t i)
{
    return p->strength ? m->trigger_mean * p->strength[i] : m->trigger;
}

/* Partial stress (src/coupling/partial_stress.c): the share of its stress that a material point leaves to the
 * crossing bonds: sigma_given = sigma - M sigma, M = T C^-1 over symmetric components. A point at the end of
 * state-based bonds gives P Q local besides, where P Q is particles.end_pull over its volume. */
struct partial_stress {
    int32_t *index; /* [n] entry of a particle, -1: gives all; NULL: none does */
    real *matrix;   /* [entries][symmetric^2], row major */
    /* [entries][symmetric] mean strain, by strain, of the part of the family without own bonds, 0 of points
     * without bonds; NULL: bond-based [1] */
    real *local;
    bool gives_all; /* hand-shake: M and local are 0 */
    int64_t entries;
    int32_t *touched; /* particles whose entry was made anew; the reader sets touches = 0 */
    int64_t touches;
    struct partial_table *table; /* src/coupling/partial_table.c */
};

/* Is point i an end of state-based bonds? Others leave stress to bonds that only cross their cell. */
static inline bool partial_end(const struct partial_stress *partial, int64_t i, int dim)
{
    if (!partial->local || partial->index[i] < 0) return false;
    bool any = partial->gives_all;
    for (int k = 0; k < symmetric_count(dim) && !any; k++)
        any = partial->local[partial->index[i] * symmetric_count(dim) + k] != 0;
    return any;
}

/* What the transfers need besides particles and grid. */
struct transfer_data {
    const struct transfer_order *order;
    const struct partial_stress *partial;
    const struct elastic *elastic; /* by material */
    real half_width;               /* l_p of uGIMP: half the particle's reference edge [m] */
    real dt;                       /* [s] */
    real dt_velocity;              /* dt, but dt/2 in the first step (leap-frog start) [s] */
    bool momentum_only;            /* grid-coupled peridynamic particles: no stress to give or update */
    const uint8_t *bonded;         /* [n] not 0: bonds meet this material point; NULL: they meet none */
    bool second_map;               /* FLIP: all points move with the velocities of the second map */
    real *turn[3];                 /* [n] of points that turn (data/turning.h); in the plane the last alone */
};

/* How peridynamic particles move in a step. */
struct pd_motion {
    real dt;               /* [s] */
    real dt_velocity;      /* dt, but dt/2 in the first step (leap-frog start) [s] */
    real fastest;          /* a faster particle, or one without finite speed, has diverged [m/s] */
    const uint8_t *loaded; /* [n] not 0: is moved after the loads; NULL: none */
    bool diverged;         /* a particle has diverged */
};

/* Force of all intact bonds on the particle of every active row (active_set.h; overwrites f there), then breaks
 * bonds that are stretched beyond their limit. A bond acts until the moment within the step at which it passes its
 * limit (pd/bond_last.h), so that where a crack goes and what it costs are of second order in the time step. Sets
 * FLAG_LOST_BOND (and FLAG_CRACKED where neither end is driven), damage, broken counts and fracture energy. What it
 * reads per bond depends on the kind of the column (bonds/bond_storage.h); positions come from cache, velocities of
 * bonds that break. Returns the directed bonds broken.
 * With `motion` active peridynamic particles that the grid does not move and that are not `loaded` move in the same
 * sweep (sweep.h). */
typedef int64_t bond_force_fn(struct bonds *b, struct particles *p, const struct bond_limit *limit,
                              struct pd_motion *motion);

/* The same by the sweep of a model, where some bonds lead to images in clamped planes (bond_storage.h), whose sources
 * and rows have to be `loaded`: what such bonds do to their images is brought back to the sources (clamp_force.c). The
 * only way to forces of bonds. */
KERNEL(int64_t, bond_forces,
       (bond_force_fn * sweep, struct bonds *b, struct particles *p, const struct bond_limit *limit,
        struct pd_motion *motion));

/* Dilatation, spring and rotation of the families, into b->state: the first half of a state-based force. To be
 * called where states are read without a sweep of forces. Material points at the end of bonds receive the
 * reaction on their cells (particles.end_pull, end_moment). */
typedef void state_precompute_fn(struct bonds *b, struct particles *p);

/* The rule of breaking, applied to one row block that has its forces. Exact and slow: called where a bond may break.
 * Returns directed bonds broken. */
KERNEL(int64_t, bond_break_row_block,
       (struct bonds *b, struct particles *p, const struct bond_limit *limit, int64_t row_block));

/* Gives entry q of a row the weight w; 0 breaks it. Half of what the row loses of its energy by that is booked as
 * fracture: a leap-frog kick stands half before and half after a change of weights, so the other half is lost to the
 * next positions. The other entry of the bond has to fade alike. */
KERNEL(void, bond_fade, (struct bonds *b, struct particles *p, int64_t row, int64_t q, real w));

/* A bound, close above, of the largest stretch of the bonds of a row block [1]. */
KERNEL(real, bond_row_block_stretch, (const struct bonds *b, const struct particles *p, int64_t row_block));

/* Ends entry q of a row at the present places, whatever its stretch, and books its energy. The other entry of the bond
 * has to end alike. */
KERNEL(void, bond_part,
       (struct bonds *b, struct particles *p, const struct bond_limit *limit, int64_t row, int64_t q));

/* Makes entry q of a row, which a trial has broken, whole again, with the weight that it had. What the row has booked
 * as fracture, and damage and flags of its particle, are the caller's to restore. */
KERNEL(void, bond_mend, (struct bonds *b, struct particles *p, int64_t row, int64_t q, real w));

/* Elastic energy of a row of a state-based model by its present weights and places, `ago` before the present [s],
 * whatever the last sweep left [J]. */
KERNEL(real, state_row_energy, (const struct bonds *b, const struct particles *p, int64_t row, real ago));

/* Half the elastic energy of every row's intact bonds, added up in fixed blocks [J]. */
typedef real bond_energy_fn(const struct bonds *b, const struct particles *p);

/* Half the plastic work k (s_y alpha + H_b alpha^2/2) of every row's bonds, broken ones included, added up in fixed
 * blocks [J]. 0 where no bond yields. */
KERNEL(real, bond_plastic_work, (const struct bonds *b));
/* The same of one row, where bonds yield. */
KERNEL(real, bond_row_plastic_work, (const struct bonds *b, int64_t row));
/* Mean plastic path of the intact bonds of a row, each by its energy at one stretch [1]: of flow along a line the
 * plastic strain, and of a point that has just converted that which it had. */
KERNEL(real, bond_row_plastic_path, (const struct bonds *b, int64_t row));

/* Bond virial (1/2V) sum F (x) (x_j - x_i) of every peridynamic row into stress [Pa]; when: particles.stress. */
typedef void bond_stress_fn(const struct bonds *b, struct particles *p);

/* v += dt_velocity f/m, x += dt v of those of the n listed particles that are peridynamic and that the grid does not
 * move; in ascending order from a 32-byte boundary on. Returns whether one of them is diverged. */
typedef bool pd_move_fn(struct particles *p, const int32_t *list, int64_t n, const struct pd_motion *motion);

/* Whether one of the n listed particles, in ascending order from a 32-byte boundary on, is faster than `limit` [m/s]
 * or has a place or velocity that is no finite number. */
KERNEL(bool, particles_diverged, (const struct particles *p, const int32_t *list, int64_t n, real limit));

/* First map: mass, momentum, and force -V sigma_given . grad N + N f (Zeng et al. 2022, eqs. 33-38). */
typedef void p2g_fn(struct grid *g, const struct particles *p, const struct transfer_data *t);

/* v_p += sum N (f/m dt), then momentum of the second map, with the same weights (steps 4 and 6; MUSL, FLIP only). */
typedef void remap_fn(struct grid *g, struct particles *p, const struct transfer_data *t);

/* The two halves of that map for points that turn (remap_turn.c): v_p += sum N (f/m dt), and turn becomes the angular
 * momentum that a point lacks [kg m^2/s]; then momentum m N (v_p + turn x (x_I - x_p)) to the nodes, turn the spin of
 * the point's group [1/s]. Planes and solids. */
typedef void turn_gather_fn(const struct grid *g, struct particles *p, const struct transfer_data *t);
typedef void turn_scatter_fn(struct grid *g, const struct particles *p, const struct transfer_data *t);

/* x_p += dt sum N v, velocity gradient, strain, spin, stress, volume, conversion flag (steps 4, 7, 8); with APIC
 * also v_p and its gradient; plastic strain of materials that yield. Returns how many points entered another cell. */
typedef int64_t g2p_fn(const struct grid *g, struct particles *p, const struct transfer_data *t);

/* Adds value[k] sum N of the listed points to `field`; serial. */
typedef void spread_fn(const struct grid *g, const struct particles *p, real half_width, const int32_t *list, int64_t n,
                       const real *value, real *field);

struct kernels { /* chosen once, before the loop                              */
    bond_force_fn *bond_force;
    bond_energy_fn *bond_energy;
    bond_stress_fn *bond_stress;
    pd_move_fn *pd_move;
    p2g_fn *p2g;
    remap_fn *remap;
    turn_gather_fn *turn_gather; /* NULL on a line */
    turn_scatter_fn *turn_scatter;
    g2p_fn *g2p;
    spread_fn *spread;
};

KERNEL_TABLE(bond_force_fn, bond_force_table, [PD_MODELS]);
KERNEL_TABLE(bond_energy_fn, bond_energy_table, [PD_MODELS]);
KERNEL_TABLE(bond_stress_fn, bond_stress_table, [PD_MODELS]);
KERNEL_TABLE(bond_force_fn, state_force_table, [PD_MODELS]);
KERNEL_TABLE(bond_energy_fn, state_energy_table, [PD_MODELS]);
KERNEL_TABLE(bond_stress_fn, state_stress_table, [PD_MODELS]);
KERNEL_TABLE(state_precompute_fn, state_precompute_table, [PD_MODELS]);
KERNEL_TABLE(pd_move_fn, pd_move_table, );
KERNEL_TABLE(p2g_fn, p2g_table, [SHAPES][TRANSFERS]);
KERNEL_TABLE(remap_fn, remap_table, [SHAPES]);
KERNEL_TABLE(turn_gather_fn, turn_gather_table, [SHAPES]);
KERNEL_TABLE(turn_scatter_fn, turn_scatter_table, [SHAPES]);
KERNEL_TABLE(g2p_fn, g2p_table, [SHAPES][TRANSFERS]);
KERNEL_TABLE(spread_fn, spread_table, [SHAPES]);

KERNEL(void, kernels_choose,
       (struct kernels *k, int dim, enum pd_model model, enum shape shape, enum transfer transfer));

/* ---- nodal updates between the maps, any dimension --------------------------------------------------------------- */

KERNEL(void, grid_clear, (struct grid *g)); /* mass, momentum, force = 0 */

/* Step 3, in two parts, between which bodies on grids of their own meet: nodes move, walls and mirrors hold. velocity =
 * (momentum + dt_velocity force)/mass; force becomes the change of velocity; momentum = 0, ready for the second map. At
 * walls the velocity is prescribed and the change is that of the prescribed motion. Nodes lighter than `smallest_mass`
 * [kg] are left at rest. Nodes beyond planes of symmetry follow their images. Dashpots act in the first part, and what
 * they took is in grid.absorbed. Adds what the walls gave to impulse [N s]
 * and work [J]; with APIC, where particles take the nodal velocity itself, that includes the momentum they replaced. */
KERNEL(void, grid_advance, (struct grid *g, enum transfer transfer, real dt_velocity, real smallest_mass));
KERNEL(void, grid_constrain,
       (struct grid *g, enum transfer transfer, real smallest_mass, real impulse[DIM_MAX], real *work));
static inline void grid_move(struct grid *g, enum transfer transfer, real dt_velocity, real smallest_mass,
                             real impulse[DIM_MAX], real *work)
{
    grid_advance(g, transfer, dt_velocity, smallest_mass);
    grid_constrain(g, transfer, smallest_mass, impulse, work);
}

/* Step 6: momentum of the second map becomes its velocity, in place; walls prescribe. */
KERNEL(void, grid_remapped, (struct grid *g, real smallest_mass));

/* ---- the mesh of the reference frame (mesh.h), any dimension ----------------------------------------------------- */

/* f = 0. */
KERNEL(void, mesh_clear, (struct mesh *mesh));

/* Adds the internal forces of the active cells (active_set.h) to the nodes; runs whose points may be past their
 * trigger are marked `stressed`. `finite`: Biot strain in axes that rotate with the cell, else the symmetric
 * gradient (mesh_law.h). Of the particles only the reactions of bonds on the points at their ends are read; where they
 * have a relief, points that yield flow from the state that they have, which moves on (mesh_flow.h). */
KERNEL(void, mesh_force, (struct mesh *mesh, const struct particles *p, const struct elastic *m, bool finite));

/* v += dt_velocity f/m, u += dt v of the active nodes, u rounded to multiples of mesh->rounding; walls prescribe
 * their velocity, and their reaction adds to impulse [N s] and work [J]; dashpots act, and what they took is in
 * grid.absorbed. f becomes m dv/dt_velocity of each node.
 * Returns the largest component of a velocity, infinite where one is not finite [m/s]. */
KERNEL(real, mesh_move, (struct mesh *mesh, real dt, real dt_velocity, real impulse[DIM_MAX], real *work));

/* Position and velocity of all its points; of those that mesh->exposed_list names; of those among the n listed
 * particles. */
KERNEL(void, mesh_points_move, (const struct mesh *mesh, struct particles *p));
KERNEL(void, mesh_exposed_move, (const struct mesh *mesh, struct particles *p));
KERNEL(void, mesh_listed_move, (const struct mesh *mesh, struct particles *p, const int32_t *list, int64_t n));
/* Adds the forces f of the points that mesh->exposed_list names to the nodes; serial. */
KERNEL(void, mesh_exposed_force, (struct mesh *mesh, const struct particles *p));
/* Cauchy stress and volume of all points of the mesh. */
KERNEL(void, mesh_points_stress, (const struct mesh *mesh, struct particles *p, const struct elastic *m, bool finite));
/* Displacement gradient du_a/dX_b of all points of the mesh, to[a dim + b] [1]. */
KERNEL(void, mesh_points_gradient, (const struct mesh *mesh, real *const *to));
/* FLAG_STRESSED for points past their trigger, in the partial cells and runs that mesh_force marked. */
KERNEL(void, mesh_points_mark, (const struct mesh *mesh, struct particles *p, const struct elastic *m, bool finite));

/* Marks the whole cells, in the runs that mesh_force marked (`all`: in all runs), of which a point may have a principal
 * stress above `share` of the trigger: mark [grid.n] = 1. */
KERNEL(void, mesh_cells_mark, (const struct mesh *mesh, const struct elastic *m, real share, bool all, uint8_t *mark,
                               bool finite));

/* Meshes of coarse cells: the velocities `to` [dim][grid.n] of nodes whose momentum over mass is `from`
 * (mesh_inertia.c). */
KERNEL(void, mesh_velocity, (const struct mesh *mesh, real *const *from, real *const *to));

/* Sum of 1/2 m v^2 of the nodes, and of 1/4 (dt f)^2/m [J]. */
KERNEL(real, mesh_kinetic, (const struct mesh *mesh));
KERNEL(real, mesh_kick, (const struct mesh *mesh, real dt));
/* Elastic energy of the cells, with their part in that of the families of points at the ends of bonds [J]. */
KERNEL(real, mesh_strain, (const struct mesh *mesh, const struct particles *p, const struct elastic *m, bool finite));
/* Sets particles.end_strain and end_rotation, of points at the ends of state-based bonds, from their cells. */
KERNEL(void, mesh_ends_update, (const struct mesh *mesh, struct particles *p, bool finite));

#endif

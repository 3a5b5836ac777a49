/* The hot loops: declares every kernel with what it reads, writes and returns. Each kernel has one body and many
 * instances (simd/variants.h). Plain references for tests: tests/support/reference.h (bond kernels), the tests of grid
 * and mesh (their kernels). Kernels cannot fail; they use no files, scenes, allocation or clocks. */
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
    PD_BOND,         /* elastic, brittle */
    PD_BOND_PLASTIC, /* elastic-plastic, brittle; needs the plastic arrays of struct bonds */
    PD_OSPD,         /* ordinary state-based (Silling et al. 2007); needs struct state */
    PD_MOSPD,        /* modified state-based: with the rotations of the particles (pd/state_laws.h) */
    PD_MODELS
};

/* Elastic constants of a material for the stress update, and the stress at which its points convert. */
struct elastic {
    real c11, c12, shear; /* stiffnesses C11, C12 and shear modulus of the space [Pa] */
    real trigger; /* sigma_1 at which a point is marked for conversion, INFINITY: never; where strength scatters: of the
                     weakest point [Pa] */
    real trigger_mean;     /* sigma_1 of conversion of a point of strength 1; equals `trigger` without scatter [Pa] */
    real yield, hardening; /* yield stress sigma_y, 0: elastic; hardening modulus H (mpm/plastic.h) [Pa] */
    real poisson;          /* Poisson's ratio in plane strain, where the material yields [1] */
    enum space space;
};

/* Returns the largest principal stress at which material point i of material m is marked for conversion [Pa]. */
static inline real point_trigger(const struct elastic *m, const struct particles *p, int64_t i)
{
    return p->strength ? m->trigger_mean * p->strength[i] : m->trigger;
}

/* Partial stress (src/coupling/partial_stress.c): the stress that a material point transmits to the grid where PD-MPM
 * bonds cross its cell and carry the rest: sigma_given = sigma - M sigma, M = T C^-1 over symmetric components. A point
 * bonded by state-based bonds transmits P Q local in addition, with P Q = particles.end_pull / volume. */
struct partial_stress {
    int32_t *index; /* [n] entry of a particle in `matrix`, -1: transmits all of its stress; NULL: all particles do */
    real *matrix;   /* M, [entries][symmetric^2], row major [1] */
    /* [entries][symmetric] derivative by strain of the share of the family's mean strain that the cell adds; 0 for
     * points without bonds; NULL: bond-based model [1] */
    real *local;
    bool gives_all; /* all stress is transmitted (coupling `handshake`): M and local are 0 */
    int64_t entries;
    int32_t *touched; /* particles whose entries were recomputed; the reader sets touches = 0 */
    int64_t touches;
    struct partial_table *table; /* table of the segments of lattice bonds in cells (src/coupling/partial_table.c) */
};

/* Returns true if material point i is bonded by state-based bonds, false if bonds at most cross its cell. */
static inline bool partial_end(const struct partial_stress *partial, int64_t i, int dim)
{
    if (!partial->local || partial->index[i] < 0) return false;
    bool any = partial->gives_all;
    for (int k = 0; k < symmetric_count(dim) && !any; k++)
        any = partial->local[partial->index[i] * symmetric_count(dim) + k] != 0;
    return any;
}

/* Inputs of the particle-grid transfers besides particles and grid; all pointers are borrowed. */
struct transfer_data {
    const struct transfer_order *order;
    const struct partial_stress *partial;
    const struct elastic *elastic; /* [materials] */
    real half_width;               /* l_p of uGIMP: half the particle's reference edge [m] */
    real dt;                       /* [s] */
    real dt_velocity;              /* step of the velocities: dt, but dt/2 in the first step (leap-frog start) [s] */
    bool momentum_only;    /* transfers momentum only: grid-coupled peridynamic particles, which have no stress */
    const uint8_t *bonded; /* [n] not 0: the material point has bonds; NULL: none has */
    bool second_map;       /* FLIP: all points move with the velocities of the second map */
    real *turn[3]; /* [n] spin or angular momentum of points that rotate with a group (data/turning.h); in 2D only
                      turn[2] */
};

/* Step sizes and limits of the motion of peridynamic particles in one step. */
struct pd_motion {
    real dt;               /* [s] */
    real dt_velocity;      /* step of the velocities: dt, but dt/2 in the first step (leap-frog start) [s] */
    real fastest;          /* speed above which a particle counts as diverged [m/s] */
    const uint8_t *loaded; /* [n] not 0: the particle moves after the loads are applied; NULL: no such particles */
    bool diverged;         /* result: a particle has diverged */
};

/* Computes the force of all intact bonds on the particle of every active row (active_set.h; overwrites p->f there),
 * then breaks bonds that are stretched beyond their limit. A breaking bond acts until the time within the step at which
 * it passes its limit (pd/bond_last.h), so crack path and fracture energy are of second order in the time step. Sets
 * FLAG_LOST_BOND (and FLAG_CRACKED where neither particle is driven), damage, broken counts and fracture energy. Bytes
 * read per bond: by the kind of the column (bonds/bond_storage.h); positions come from cache, velocities are read of
 * breaking bonds only. Returns the number of directed bonds broken. motion: NULL, or moves active peridynamic particles
 * that are neither on the grid nor `loaded` in the same sweep (pd/sweep.h). */
typedef int64_t bond_force_fn(struct bonds *b, struct particles *p, const struct bond_limit *limit,
                              struct pd_motion *motion);

/* Computes the forces of all bonds by `sweep`, the kernel of the model, and adds the reactions of bonds to images in
 * clamped planes to the sources of these images (pd/clamp_force.c). The sources and the rows of such bonds must be
 * `loaded`. All callers compute bond forces through this function. Returns the number of directed bonds broken. */
KERNEL(int64_t, bond_forces,
       (bond_force_fn * sweep, struct bonds *b, struct particles *p, const struct bond_limit *limit,
        struct pd_motion *motion));

/* Computes dilatation, spring and rotation of all families and stores them in b->state: the first sweep of a
 * state-based force. Required before state-based quantities are read without a force sweep. Stores the reactions on the
 * cells of bonded material points (particles.end_pull, end_moment). */
typedef void state_precompute_fn(struct bonds *b, struct particles *p);

/* Breaks the bonds of one row block that are beyond their limit; the forces of the row block must be up to date. Scalar
 * and exact, hence called only where a bond may break. Returns the number of directed bonds broken. */
KERNEL(int64_t, bond_break_row_block,
       (struct bonds *b, struct particles *p, const struct bond_limit *limit, int64_t row_block));

/* Sets the weight of bond q of a row to w [1]; w = 0 breaks the bond. Books half of the row's loss of elastic energy as
 * fracture energy: a leap-frog kick is centred on the change of weights, so the other half is lost in the step to the
 * next positions. The caller sets the weight of the bond's entry in the other row likewise. */
KERNEL(void, bond_fade, (struct bonds *b, struct particles *p, int64_t row, int64_t q, real w));

/* Returns an upper bound, up to round-off, of the largest bond stretch in a row block [1]. */
KERNEL(real, bond_row_block_stretch, (const struct bonds *b, const struct particles *p, int64_t row_block));

/* Breaks bond q of a row at the present positions, whatever its stretch, and books its energy. The caller breaks the
 * bond's entry in the other row likewise. */
KERNEL(void, bond_break_entry,
       (struct bonds *b, struct particles *p, const struct bond_limit *limit, int64_t row, int64_t q));

/* Restores bond q of a row, broken by a trial step, with weight w. The caller restores fracture energy of the row,
 * damage and flags of its particle. */
KERNEL(void, bond_restore_entry, (struct bonds *b, struct particles *p, int64_t row, int64_t q, real w));

/* Returns the elastic energy of a row of a state-based model [J] from its present weights and the positions a time
 * `lag` before the present ones [s]; independent of the last sweep. */
KERNEL(real, state_row_energy, (const struct bonds *b, const struct particles *p, int64_t row, real lag));

/* Returns half the elastic energy of the intact bonds of all rows, summed in fixed blocks [J]. */
typedef real bond_energy_fn(const struct bonds *b, const struct particles *p);

/* Returns half the plastic work k (s_y alpha + H_b alpha^2/2) of the bonds of all rows, broken ones included, summed in
 * fixed blocks [J]; 0 where no bond yields. */
KERNEL(real, bond_plastic_work, (const struct bonds *b));
/* Returns half the plastic work of the bonds of one row [J]; only where bonds yield. */
KERNEL(real, bond_row_plastic_work, (const struct bonds *b, int64_t row));
/* Returns the mean accumulated plastic stretch of the intact bonds of a row [1], weighted by bond energy at equal
 * stretch. For uniaxial flow: the plastic strain; for a point that has just converted: its plastic strain as a material
 * point. */
KERNEL(real, bond_row_plastic_path, (const struct bonds *b, int64_t row));

/* Stores the bond virial (1/2V) sum F (x) (x_j - x_i) of every peridynamic row in p->stress [Pa]. */
typedef void bond_stress_fn(const struct bonds *b, struct particles *p);

/* Moves the peridynamic particles among n listed ones that the grid does not move: v += dt_velocity f/m, x += dt v.
 * list: ascending, aligned to 32 bytes. Returns true if one of them has diverged. */
typedef bool pd_move_fn(struct particles *p, const int32_t *list, int64_t n, const struct pd_motion *motion);

/* Returns true if one of the n listed particles is faster than `limit` [m/s] or has a position or velocity that is not
 * finite. list: ascending, aligned to 32 bytes. */
KERNEL(bool, particles_diverged, (const struct particles *p, const int32_t *list, int64_t n, real limit));

/* First map: adds mass, momentum and force -V sigma_given . grad N + N f of the points to the nodes (Zeng et al. 2022,
 * eqs. 33-38). */
typedef void p2g_fn(struct grid *g, const struct particles *p, const struct transfer_data *t);

/* Updates velocities, v_p += sum N (f/m dt), then maps the momentum to the nodes again with equal weights (MUSL, Zeng
 * et al. 2022, steps 4 and 6); FLIP only. */
typedef void remap_fn(struct grid *g, struct particles *p, const struct transfer_data *t);

/* Gathers for the second map of rotating points (mpm/remap_turn.c): v_p += sum N (f/m dt), and stores in t->turn the
 * angular momentum that a point lacks [kg m^2/s]. 2D and 3D. */
typedef void turn_gather_fn(const struct grid *g, struct particles *p, const struct transfer_data *t);

/* Scatters for the second map of rotating points: adds momentum m N (v_p + turn x (x_I - x_p)) to the nodes; t->turn
 * holds the spin of each point's group [1/s]. */
typedef void turn_scatter_fn(struct grid *g, const struct particles *p, const struct transfer_data *t);

/* Moves points, x_p += dt sum N v, and updates velocity gradient, strain, spin, stress, volume, plastic strain and
 * conversion flag (Zeng et al. 2022, steps 4, 7, 8); with APIC also v_p and its gradient (Jiang et al. 2015). Returns
 * the number of points that entered another cell. */
typedef int64_t g2p_fn(const struct grid *g, struct particles *p, const struct transfer_data *t);

/* Adds value[k] N of listed point k to the nodal `field`, for k = 0 .. n-1. Serial. */
typedef void spread_fn(const struct grid *g, const struct particles *p, real half_width, const int32_t *list, int64_t n,
                       const real *value, real *field);

/* The kernels of a run, chosen once at set-up. */
struct kernels {
    bond_force_fn *bond_force;
    bond_energy_fn *bond_energy;
    bond_stress_fn *bond_stress;
    pd_move_fn *pd_move;
    p2g_fn *p2g;
    remap_fn *remap;
    turn_gather_fn *turn_gather; /* NULL in 1D */
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

/* Sets mass, momentum and force of all nodes to 0. */
KERNEL(void, grid_clear, (struct grid *g));

/* Zeng et al. 2022, step 3, first part: velocity = (momentum + dt_velocity force)/mass at all nodes; force becomes the
 * change of velocity; momentum = 0. Nodes lighter than `smallest_mass` [kg] are left at rest. Dashpots act here; their
 * energy and impulse are added to grid.absorbed. Contact of bodies on separate grids acts between this part and
 * grid_constrain. */
KERNEL(void, grid_advance, (struct grid *g, enum transfer transfer, real dt_velocity, real smallest_mass));

/* Step 3, second part: walls prescribe the velocity of their nodes, and `force` becomes the change of the prescribed
 * motion; nodes beyond planes of symmetry follow their images. Adds the reaction of the walls to impulse [N s] and its
 * work to *work [J]; with APIC, where particles take the nodal velocity itself, including the momentum that was
 * replaced. */
KERNEL(void, grid_constrain,
       (struct grid *g, enum transfer transfer, real smallest_mass, real impulse[DIM_MAX], real *work));

/* Runs both parts of step 3, for a body that meets no other grid. */
static inline void grid_move(struct grid *g, enum transfer transfer, real dt_velocity, real smallest_mass,
                             real impulse[DIM_MAX], real *work)
{
    grid_advance(g, transfer, dt_velocity, smallest_mass);
    grid_constrain(g, transfer, smallest_mass, impulse, work);
}

/* Step 6: converts the momentum of the second map to velocity, in place; walls prescribe their velocity. */
KERNEL(void, grid_remapped, (struct grid *g, real smallest_mass));

/* ---- the mesh of the reference frame (mesh.h), any dimension ----------------------------------------------------- */

/* Sets the forces on all nodes to 0. */
KERNEL(void, mesh_clear, (struct mesh *mesh));

/* Adds the internal forces of the active cells (active_set.h) to the nodes and marks runs whose points may be past
 * their trigger as `stressed`. p: read for the bond reactions on bonded points (particles.end_*); where p has
 * plastic_correction, yielding points flow from their present plastic state, which is updated (mesh_flow.h). finite:
 * true for Biot strain in axes that rotate with the cell, false for the symmetric gradient (mesh_law.h). */
KERNEL(void, mesh_force, (struct mesh *mesh, const struct particles *p, const struct elastic *m, bool finite));

/* Moves the active nodes: v += dt_velocity f/m, u += dt v, with u rounded to multiples of mesh->rounding. Walls
 * prescribe their velocity; their reaction is added to impulse [N s] and *work [J]. Dashpots act; their energy and
 * impulse are added to grid.absorbed. f becomes m dv/dt_velocity of each node. Returns the largest velocity component,
 * infinite if one is not finite [m/s]. */
KERNEL(real, mesh_move, (struct mesh *mesh, real dt, real dt_velocity, real impulse[DIM_MAX], real *work));

/* Updates position and velocity of all points of the mesh from its nodes. */
KERNEL(void, mesh_points_move, (const struct mesh *mesh, struct particles *p));

/* Updates position and velocity of the points in mesh->exposed_list. */
KERNEL(void, mesh_exposed_move, (const struct mesh *mesh, struct particles *p));

/* Updates position and velocity of the mesh points among n listed particles. */
KERNEL(void, mesh_listed_move, (const struct mesh *mesh, struct particles *p, const int32_t *list, int64_t n));
/* Adds the forces f of the points in mesh->exposed_list to the nodes. Serial. */
KERNEL(void, mesh_exposed_force, (struct mesh *mesh, const struct particles *p));
/* Computes Cauchy stress and volume of all points of the mesh; finite: as in mesh_force. */
KERNEL(void, mesh_points_stress, (const struct mesh *mesh, struct particles *p, const struct elastic *m, bool finite));
/* Computes the displacement gradient of all points of the mesh: du_a/dX_b of point i in to[a dim + b][i] [1]. */
KERNEL(void, mesh_points_gradient, (const struct mesh *mesh, real *const *to));
/* Sets FLAG_STRESSED for points past their trigger, in the partial cells and runs that mesh_force marked. */
KERNEL(void, mesh_points_mark, (const struct mesh *mesh, struct particles *p, const struct elastic *m, bool finite));

/* Marks whole cells in which a point may have a principal stress above `share` [1] of the trigger: mark[cell] = 1.
 * mark: [grid.n], not cleared. all: true visits all runs, false only those that mesh_force marked. */
KERNEL(void, mesh_cells_mark, (const struct mesh *mesh, const struct elastic *m, real share, bool all, uint8_t *mark,
                               bool finite));

/* For meshes of coarse cells: computes the nodal velocities `to` from `from` = momentum over mass, both [dim][grid.n]
 * [m/s], with the blended mass of mesh_inertia.c. */
KERNEL(void, mesh_velocity, (const struct mesh *mesh, real *const *from, real *const *to));

/* Returns the kinetic energy, sum of 1/2 m v^2 over the nodes [J]. */
KERNEL(real, mesh_kinetic, (const struct mesh *mesh));

/* Returns the sum of 1/4 (dt f)^2/m over the nodes [J], the correction of kinetic energy to the time of the
 * positions. */
KERNEL(real, mesh_kick, (const struct mesh *mesh, real dt));
/* Returns the elastic energy of the cells [J], their share in the families of bonded points included. */
KERNEL(real, mesh_strain, (const struct mesh *mesh, const struct particles *p, const struct elastic *m, bool finite));
/* Computes particles.end_strain and end_rotation of bonded points (state-based models) from the deformation of their
 * cells. */
KERNEL(void, mesh_ends_update, (const struct mesh *mesh, struct particles *p, bool finite));

#endif

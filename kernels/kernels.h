/* Declares the kernels (the functions of the hot loops): what each reads, writes and returns. A kernel is written once
 * and compiled for each combination of dimension and model or shape function (simd/variants.h). Tests compare kernels
 * with plain code: those of bonds in tests/support/reference.h, those of grid and mesh in their tests. Kernels cannot
 * fail; they use no files, scenes, allocation or clocks. */
#ifndef CLEAVE_KERNELS_KERNELS
#define CLEAVE_KERNELS_KERNELS

#include "bonds/bonds.h"
#include "data/grid.h"
#include "data/law.h"
#include "kernels/simd/kernel.h"
#include "data/mesh.h"
#include "data/particles.h"
#include "data/transfer_order.h"
#include "data/turning.h"

/* Shape functions of the material points on the background grid: linear, GIMP, cpGIMP, quadratic and cubic B-spline
 * (kernels/mpm/shape.h). */
enum shape { SHAPE_LINEAR, SHAPE_GIMP, SHAPE_CPGIMP, SHAPE_QUADRATIC, SHAPE_CUBIC, SHAPES };
/* Transfer of velocities from the grid to points: changes of velocity (FLIP), or velocities and their gradient
 * (APIC). */
enum transfer { TRANSFER_FLIP, TRANSFER_APIC, TRANSFERS };
/* Peridynamic models, each with kernels of its own. */
enum pd_model {
    PD_BOND,         /* elastic, brittle */
    PD_BOND_PLASTIC, /* bond-based, elastic-plastic, brittle; needs the plastic arrays of struct bonds */
    PD_BOND_SOFT,    /* bond-based, elastic, softening; needs struct softened */
    PD_OSPD,         /* ordinary state-based (Silling et al. 2007); needs struct state */
    PD_MOSPD,        /* modified state-based: with the rotations of the particles (pd/state_laws.h) */
    PD_MODELS
};

/* Elastic constants of a material for the stress update of material points, and the stress at which these points are
 * marked for conversion to peridynamic particles. */
struct elastic {
    real c11, c12, shear; /* stiffnesses C11, C12 and shear modulus of the space [Pa] */
    real trigger; /* sigma_1 at which a point is marked for conversion, INFINITY: never; where strength scatters: of the
                     weakest point [Pa] */
    real trigger_mean; /* sigma_1 of conversion of a point of strength 1; equals `trigger` without scatter [Pa] */
    real poisson;      /* Poisson's ratio in plane strain [1] */
    /* strength surface; if its g0 is not 0, points also convert where U g0 = sqrt(J2) + g1 I1 exceeds `failure` */
    struct strength_surface surface;
    real failure; /* value of U g0 at which points convert; where strength scatters, of a point of strength 1 [Pa] */
    enum space space;
    const struct law *law; /* law by which the material yields; NULL: it is elastic */
    enum law_mode mode;    /* how the plastic strain of a step is computed from the law */
    bool mean_dilatation;  /* the points of a cell have its mean dilatation (mpm/dilatation.h, mesh/mesh_law.h) */
};

/* Returns the largest principal stress [Pa] at which material point i of p is marked for conversion to a peridynamic
 * particle. m: constants of its material. The stress is m->trigger, or, where strength is random, m->trigger_mean times
 * the strength of the point. */
static inline real point_stress_threshold_for_conversion_to_pd(const struct elastic *m, const struct particles *p,
                                                               int64_t i)
{
    return p->strength ? m->trigger_mean * p->strength[i] : m->trigger;
}

/* Partial stress (src/coupling/partial_stress.c). Where bonds between peridynamic particles and material points (PD-MPM
 * bonds) cross the cell of a material point, they carry the part M sigma of its stress sigma, and the point transmits
 * the rest, sigma - M sigma, to the grid. M = T C^-1 over symmetric components, with the stiffness T of these bonds and
 * C of the material. A point with state-based bonds of its own also transmits the stress `local` times p/V to the grid,
 * with the reaction p of its bonds (particles.end_pull) and its volume V. */
struct partial_stress {
    int32_t *index; /* [n] entry of a particle in `matrix`, -1: transmits all of its stress; NULL: all particles do */
    real *matrix;   /* M, [entries][symmetric^2], row major [1] */
    /* [entries][symmetric] derivative of the mean strain of the point's neighbourhood by the strain of its cell; 0 for
     * points without bonds; NULL: bond-based model [1] */
    real *local;
    bool gives_all;   /* all stress is transmitted (coupling `handshake`): M and local are 0 */
    int64_t entries;  /* number of entries */
    int32_t *touched; /* particles whose entries were recomputed; whoever has read them sets touches = 0 */
    int64_t touches;  /* number of these particles */
    struct bond_fraction_table
        *table; /* table of the segments of lattice bonds in cells (src/coupling/partial_table.c) */
};

/* Returns true if material point i has state-based bonds of its own; false if at most bonds of other points cross its
 * cell, or if the model is bond-based. partial: partial stresses (shares that bonds carry) of the material points,
 * which contain this information. */
static inline bool point_has_own_state_based_bonds(const struct partial_stress *partial, int64_t i, int dim)
{
    if (!partial->local || partial->index[i] < 0) return false;
    bool any = partial->gives_all;
    for (int k = 0; k < symmetric_tensor_component_count(dim) && !any; k++)
        any = partial->local[partial->index[i] * symmetric_tensor_component_count(dim) + k] != 0;
    return any;
}

/* Inputs of the transfers between particles and grid besides the particles and the grid themselves. All pointers are
 * borrowed. */
struct transfer_data {
    const struct transfer_order *order;   /* order in which points are processed: by colour, block and cell */
    const struct partial_stress *partial; /* share of their stress that bonded points leave to bonds */
    const struct elastic *elastic;        /* [materials] elastic constants */
    real half_width; /* half the width over which GIMP averages linear shape functions [m]: half the reference edge of a
                        particle; half a cell for quadratic B-splines */
    real dt;         /* time step [s] */
    real dt_velocity;      /* step of the velocities: dt, but dt/2 in the first step (leap-frog start) [s] */
    bool laws;             /* at least one material yields */
    bool mean_dilatation;  /* at least one material has the mean dilatation of cells (elastic.mean_dilatation) */
    bool momentum_only;    /* transfers momentum only: grid-coupled peridynamic particles, which have no stress */
    const uint8_t *bonded; /* [n] not 0: the material point has bonds; NULL: none has */
    real *dilatation;      /* [n] rate of dilatation of the points before it is averaged, stored by g2p [1/s]; NULL: no
                              material has mean dilatation */
    bool second_map;       /* FLIP: all points move with the nodal velocities that remap has computed (second map) */
    real *turn[3]; /* [n] spin or angular momentum of points that rotate with a group (data/turning.h); in 2D only
                      turn[2] */
};

/* Step sizes and limits for the time integration of peridynamic particles in one step. */
struct pd_motion {
    real dt;               /* [s] */
    real dt_velocity;      /* step of the velocities: dt, but dt/2 in the first step (leap-frog start) [s] */
    real fastest;          /* speed above which a particle counts as diverged [m/s] */
    const uint8_t *loaded; /* [n] not 0: the particle moves after the loads are applied; NULL: no such particles */
    bool diverged;         /* result: a particle has diverged */
};

/* Computes the force of all intact bonds of b on the particle of every active row into p->f, then breaks bonds that are
 * stretched beyond `limit`. A row holds all bonds of one particle; a row is active unless its region is still at rest.
 * A breaking bond acts until the time within the step at which it exceeds its limit (pd/bond_last.h), so that crack
 * path and fracture energy are of second order in the time step. Sets FLAG_LOST_BOND (and FLAG_CRACKED where the motion
 * of neither particle is prescribed), damage, counts of broken bonds and fracture energy. motion: step sizes, with
 * which active peridynamic particles that are neither on the grid nor marked in motion->loaded are also moved in this
 * loop (pd/sweep.h); NULL: no particle is moved. Returns the number of bonds broken, each counted once for each of its
 * particles. */
typedef int64_t bond_force_fn(struct bonds *b, struct particles *p, const struct bond_limit *limit,
                              struct pd_motion *motion);

/* Computes the forces of all bonds b on the particles p by the kernel `sweep` of the model, and breaks bonds stretched
 * beyond `limit`. Returns the number of bonds broken, each counted once for each of its particles. A clamped plane is a
 * plane of symmetry along which motion is prevented, too: the reaction on a mirror image in a clamped plane is added to
 * the force on the particle that the image mirrors (pd/clamp_force.c). motion: step sizes with which particles are
 * moved in the same loop; NULL: no particle is moved. The caller must set in motion->loaded the particles with bonds to
 * such images and the particles that these images mirror, which are moved after the loop. */
KERNEL(int64_t, bond_forces,
       (bond_force_fn * sweep, struct bonds *b, struct particles *p, const struct bond_limit *limit,
        struct pd_motion *motion));

/* Starts the softening of all bonds of b whose stretch exceeds their onset (the stretch at which softening begins), if
 * the normal stress across the bond exceeds about half the shear modulus times the stretch (pd/bond_begin.c). p:
 * particles; limit: onsets and breaking stretches. Examines the blocks of eight rows (the bonds of eight particles) in
 * which the last force computation has found such a bond. The result is the same for both particles of a bond. A bond
 * beyond its onset already loses some energy at once, which is added to the fracture energy. Called by bond_forces. */
KERNEL(void, bonds_begin_to_soften, (struct bonds *b, struct particles *p, const struct bond_limit *limit));

/* Starts the softening of all bonds of b whose stretch at the present positions of p exceeds their onset (the stretch
 * at which softening begins), if the normal stress across the bond exceeds about half the shear modulus times the
 * stretch. limit: onsets and breaking stretches. Needs no preceding force computation. For load steps (static
 * equilibria). */
KERNEL(void, bonds_open_beyond_onset, (struct bonds *b, struct particles *p, const struct bond_limit *limit));

/* Updates the damage of softening bonds of b, in state-based models: increases it to the value that follows from the
 * present positions of p if this releases energy (pd/state_soften.c), and breaks bonds that have softened completely.
 * The states of all neighbourhoods in b->state must be those of the present positions. limit: onsets and breaking
 * stretches; *changed: set to true if the damage of a bond has changed; the states of the blocks of eight rows (bonds
 * of eight particles) marked in b->soft.begun must then be computed again. Blocks with bonds that must begin to soften
 * are marked in b->soft.due for bonds_begin_to_soften. Returns the number of bonds broken, each counted once for each
 * of its particles. */
KERNEL(int64_t, state_soften,
       (struct bonds *b, struct particles *p, const struct bond_limit *limit, bool *changed));

/* Marks the bond with index q in the arrays of b as broken in row number `row` (all bonds of one particle of p): sets
 * its weight (factor on its force) to 0, and updates the counts of broken bonds, damage and flags of the particle. The
 * caller adds the energy of the bond to the fracture energy before, and marks the bond in the row of its other particle
 * likewise. */
KERNEL(void, bond_end, (struct bonds *b, struct particles *p, int64_t row, int64_t q));

/* Breaks the bonds of b whose largest stretch has reached the end of their softening (the stretch at which a softening
 * bond breaks). The energy that such a bond has dissipated becomes fracture energy of its row (the bonds of one
 * particle of p). For load steps (sequences of static equilibria), between two of them. Returns the number of bonds
 * broken, each counted once for each of its particles. */
KERNEL(int64_t, bonds_end_softened, (struct bonds *b, struct particles *p));

/* Raises the stored largest stretches of all bonds of b that soften to their stretches at the present positions of p,
 * as a force computation does. To be called before energies are read without a force computation. */
KERNEL(void, bonds_update_softening, (struct bonds *b, const struct particles *p));

/* Computes pressure (force by dilatation), spring stiffness (force by extension) and rotation of all neighbourhoods
 * (all neighbours of a particle) from the present positions into b->state: the first of the two loops of a state-based
 * force. To be called before these quantities are read without a force computation. Stores the reactions on the cells
 * of material points with bonds in p->end_pull and p->end_moment. */
typedef void family_states_precompute_fn(struct bonds *b, struct particles *p);

/* Breaks the bonds of block number `row_block` of eight rows of b (all bonds of eight particles) whose stretch exceeds
 * `limit`, and adds their energy to the fracture energy of their rows. The forces p->f on these particles must be up to
 * date; of the force of a broken bond only the share remains in p->f that acts until the bond breaks within the step
 * (pd/bond_last.h). The computation is slow, bond by bond: only for blocks in which a bond may break. Returns the
 * number of bonds broken in these rows. */
KERNEL(int64_t, bond_break_row_block,
       (struct bonds *b, struct particles *p, const struct bond_limit *limit, int64_t row_block));

/* Sets the weight (factor on the force) of the bond with index q in the arrays of b, which is in row number `row` (all
 * bonds of one particle of p), to w [1]; w = 0 breaks the bond. Adds half of the loss of elastic energy to the fracture
 * energy of the row: a leap-frog velocity update is centred on the change of weights, so the other half is lost in the
 * step to the next positions. The caller changes the weight of the bond in the row of its other particle likewise. */
KERNEL(void, bond_fade, (struct bonds *b, struct particles *p, int64_t row, int64_t q, real w));

/* Returns an upper bound [1], up to round-off, of the largest stretch of the bonds in block number `row_block` of eight
 * rows of b (bonds of eight particles of p), by which blocks far from breaking are skipped. */
KERNEL(real, bond_row_block_stretch, (const struct bonds *b, const struct particles *p, int64_t row_block));

/* Breaks the bond with index q in the arrays of b, in row number `row` (all bonds of one particle of p), at the present
 * positions, whatever its stretch, and adds its energy to the fracture energy of the row. limit->last_force: rule for
 * the share of its force that acts in the step in which it breaks. The caller breaks the bond in the row of its other
 * particle likewise. */
KERNEL(void, bond_break_entry,
       (struct bonds *b, struct particles *p, const struct bond_limit *limit, int64_t row, int64_t q));

/* Restores the bond with index q in the arrays of b, in row number `row` (all bonds of one particle of p), which a
 * trial load step (a static equilibrium that is discarded) has broken, and sets its weight (factor on its force) to w
 * [1]. The caller restores the fracture energy of the row, and damage and flags of its particle. */
KERNEL(void, bond_restore_entry, (struct bonds *b, struct particles *p, int64_t row, int64_t q, real w));

/* Returns the elastic energy [J] of the neighbourhood of row number `row` of b (all bonds of one particle of p) in a
 * state-based model, from the present weights of its bonds and the positions at a time `lag` [s] before the present
 * ones. Independent of the last force computation. */
KERNEL(real, state_row_energy, (const struct bonds *b, const struct particles *p, int64_t row, real lag));

/* Returns half the elastic energy [J] of the intact bonds of all rows of b (a row: all bonds of one particle of p). A
 * bond between two peridynamic particles is in two rows, so that its whole energy is included. In state-based models,
 * returns the energy of the neighbourhoods at the last computation of their states. The sum has equal bits on any
 * number of threads. row_energy: [b->rows]: the share of each row is added to its entry [J]; NULL: not needed. */
typedef real bond_energy_fn(const struct bonds *b, const struct particles *p, real *row_energy);

/* Returns half the plastic work k (s_y alpha + H_b alpha^2/2) [J] of the bonds of all rows of b (a row: all bonds of
 * one particle), broken bonds included; 0 if no bond yields. A bond between two peridynamic particles is in two rows,
 * so that its whole work is included. s_y: yield stretch; alpha: accumulated plastic stretch; H_b: hardening; k:
 * stiffness of a bond. */
KERNEL(real, bond_plastic_work, (const struct bonds *b));
/* Returns half the plastic work [J] of the bonds of row number `row` of b, i.e. of one particle; the rows of the
 * neighbours have the other half. Only in models whose bonds yield. */
KERNEL(real, bond_row_plastic_work, (const struct bonds *b, int64_t row));
/* Returns the mean accumulated plastic stretch [1] of the intact bonds of row number `row` of b, i.e. of one particle,
 * weighted by w |xi|, weight times reference length of a bond; 0 without intact bonds. In uniaxial flow this is the
 * plastic strain; for a particle that has just become peridynamic, its plastic strain as a material point. */
KERNEL(real, bond_row_plastic_path, (const struct bonds *b, int64_t row));

/* Computes the stress of every peridynamic particle from its bonds in b into p->stress [Pa]: the virial (1/2V) sum F
 * (x) (x_j - x_i) over the bonds, with the force F of a bond and the volume V of the particle. */
typedef void bond_stress_fn(const struct bonds *b, struct particles *p);

/* Integrates velocity and position of the peridynamic particles list[n] of p (indices, ascending, aligned to 32 bytes),
 * except those that the grid moves: v += dt_velocity f/m, x += dt v. motion: step sizes and largest speed. Returns true
 * if one of the particles has diverged (is too fast, or not finite). */
typedef bool pd_move_fn(struct particles *p, const int32_t *list, int64_t n, const struct pd_motion *motion);

/* Returns true if one of the n particles of p in `list` is faster than `limit` [m/s] or has a position or velocity that
 * is not finite. list: indices, ascending, aligned to 32 bytes. */
KERNEL(bool, particles_diverged, (const struct particles *p, const int32_t *list, int64_t n, real limit));

/* Adds mass, momentum and force of the points of p to the nodes of g: the first particle-to-grid map (Zeng et al. 2022,
 * eqs. 33-38). The force is -V sigma . grad N + N f, with the volume V and the force f of the point, the stress sigma
 * that it transmits (without the partial stress, which bonds carry), and the shape function N of the node. transfer:
 * points sorted by cell, step sizes, partial stress. */
typedef void p2g_fn(struct grid *g, const struct particles *p, const struct transfer_data *transfer);

/* Remaps momentum in the scheme MUSL (modified update stress last; Zeng et al. 2022, steps 4 and 6), for FLIP only.
 * Interpolates the change dv of the nodal velocities in this step (f dt/m, which g->force then contains [m/s]) to the
 * points of p, v_p += sum N dv with the shape function N of a node. Then adds the new momentum m_p v_p N of the points
 * to the nodal momentum of g, which grid_advance has set to 0. Called the second map in other comments (the first map
 * is p2g). transfer: points sorted by cell, step sizes. */
typedef void musl_remap_fn(struct grid *g, struct particles *p, const struct transfer_data *transfer);

/* Interpolates the change dv of the nodal velocities in this step (g->force [m/s]) to the points of p in rotating
 * groups (data/turning.h): v_p += sum N dv, with the shape function N of a node. Stores in transfer->turn the angular
 * momentum [kg m^2/s] that each point loses in this interpolation and its group must receive. First half of the
 * remapping of MUSL (grid to particles to grid); 2D and 3D. */
typedef void rotating_remap_gather_fn(const struct grid *g, struct particles *p, const struct transfer_data *transfer);

/* Adds the momentum m N (v_p + w x (x_I - x_p)) of the points of p in rotating groups (data/turning.h) to the nodes x_I
 * of g, with mass m, velocity v_p and position x_p of a point, shape function N, and the spin w of its group in
 * transfer->turn [1/s]; to second order in w dt (mpm/turn.h). Adds the masses, too, if weights are computed ahead of
 * the actual positions (g->ahead). Second half of the remapping of MUSL; 2D and 3D. */
typedef void rotating_remap_scatter_fn(struct grid *g, const struct particles *p, const struct transfer_data *transfer);

/* Moves the points of p with the nodal velocities of g, x_p += dt sum N v, and updates their stress, volume, plastic
 * strain and, with cpGIMP, the stretches of their edges. Sets FLAG_STRESSED on points whose stress requires that they
 * become peridynamic particles (Zeng et al. 2022, steps 4, 7, 8). With APIC also updates v_p and its gradient (Jiang et
 * al. 2015). transfer: points sorted by cell, step sizes, elastic constants. Returns the number of points that have
 * entered another cell. */
typedef int64_t g2p_fn(const struct grid *g, struct particles *p, const struct transfer_data *transfer);

/* Corrects stress and volume of the material points of p, in the order of `transfer`, for the mean dilatation of their
 * cells (mpm/dilatation.h): adds `share` [1] times the difference between the changes in a step by the mean dilatation
 * of the cell and by the dilatation of the point. Called with -1/2 before points that have left their cells are sorted
 * and with 1/2 afterwards: half of the step then has the old cells and half the new ones, so that changes of cells gain
 * no energy. */
KERNEL(void, points_add_mean_dilatation, (struct particles *p, const struct transfer_data *transfer, real share));

/* Distributes one value per particle to nodes: adds value[k] N of particle list[k] of p to `field` ([g->n], in the unit
 * of `value`), for k = 0 .. n - 1, with the shape functions N of the nodes. half_width: as in struct
 * transfer_data, l_p [m]. Serial. */
typedef void spread_to_nodes_fn(const struct grid *g, const struct particles *p, real half_width, const int32_t *list,
                                int64_t n, const real *value, real *field);

/* The kernels of a run, which depend on dimension, model, shape function and transfer; chosen once at set-up
 * (kernels_choose). The type of each member describes what the kernel does. */
struct kernels {
    bond_force_fn *bond_force;
    bond_energy_fn *bond_energy;
    bond_stress_fn *bond_stress;
    pd_move_fn *pd_move;
    p2g_fn *p2g;
    musl_remap_fn *remap;
    rotating_remap_gather_fn *turn_gather; /* NULL in 1D */
    rotating_remap_scatter_fn *turn_scatter;
    g2p_fn *g2p;
    spread_to_nodes_fn *spread;
};

/* Tables of all kernels, from which kernels_choose selects: entry [dim][..] is the kernel for this dimension and model,
 * shape function or transfer; NULL if there is none. */
KERNEL_TABLE(bond_force_fn, bond_force_table, [PD_MODELS]);
KERNEL_TABLE(bond_energy_fn, bond_energy_table, [PD_MODELS]);
KERNEL_TABLE(bond_stress_fn, bond_stress_table, [PD_MODELS]);
KERNEL_TABLE(bond_force_fn, state_force_table, [PD_MODELS]);
KERNEL_TABLE(bond_energy_fn, state_energy_table, [PD_MODELS]);
KERNEL_TABLE(bond_stress_fn, state_stress_table, [PD_MODELS]);
KERNEL_TABLE(family_states_precompute_fn, state_precompute_table, [PD_MODELS]);
KERNEL_TABLE(pd_move_fn, pd_move_table, );
KERNEL_TABLE(p2g_fn, p2g_table, [SHAPES][TRANSFERS]);
KERNEL_TABLE(musl_remap_fn, remap_table, [SHAPES]);
KERNEL_TABLE(rotating_remap_gather_fn, turn_gather_table, [SHAPES]);
KERNEL_TABLE(rotating_remap_scatter_fn, turn_scatter_table, [SHAPES]);
KERNEL_TABLE(g2p_fn, g2p_table, [SHAPES][TRANSFERS]);
KERNEL_TABLE(spread_to_nodes_fn, spread_table, [SHAPES]);

/* Computes mass, centre, inertia and angular velocity (spin) of each group of t, before a step. A group consists of
 * neighbouring points that rotate together (data/turning.h); sums are over its points of p on the grid. Stores in
 * t->turn, for each point, the spin of its group [1/s]. spacing: of the particles [m]. */
KERNEL(void, corotating_groups_compute_spins, (struct corotating_groups *t, struct particles *p, real spacing));

/* Returns lost angular momentum to the points of each group of t (points that rotate together, data/turning.h): adds up
 * what its points (of p) have lost in the transfer from the grid (t->turn [kg m^2/s]), and adds a rotation about its
 * centre of mass with this angular momentum to their velocities. Then stores in t->turn, for each point, the new
 * angular velocity of its group [1/s]. Positions must be those of corotating_groups_compute_spins. */
KERNEL(void, corotating_groups_restore_angular_momentum, (struct corotating_groups *t, struct particles *p));

/* Stores in k the kernels for bodies of `dim` dimensions with the given peridynamic model, shape function of the grid
 * and transfer scheme (FLIP or APIC). The combination must exist in simd/variants.h. */
KERNEL(void, kernels_choose,
       (struct kernels *k, int dim, enum pd_model model, enum shape shape, enum transfer transfer));

/* ---- nodal updates between the maps, any dimension --------------------------------------------------------------- */

/* Sets mass, momentum and force of all nodes of the grid g to 0. */
KERNEL(void, grid_clear, (struct grid *g));

/* Computes the nodal velocities (momentum + dt_velocity force)/mass of g (Zeng et al. 2022, step 3, first part);
 * `force` becomes the change of velocity, momentum becomes 0. Nodes lighter than smallest_mass [kg] are left at rest.
 * transfer: FLIP or APIC. Applies dashpots and adds their energy and impulse to g->absorbed. Contact of bodies on
 * separate grids acts between this function and grid_constrain. */
KERNEL(void, grid_advance, (struct grid *g, enum transfer transfer, real dt_velocity, real smallest_mass));

/* Applies the constraints of the grid g to its nodal velocities (Zeng et al. 2022, step 3, second part): nodes with a
 * prescribed velocity (walls) receive it, and their `force` becomes the change of this velocity; nodes beyond planes of
 * symmetry move as mirror images. transfer: FLIP or APIC. Adds the reactions of walls and planes to impulse [N s] and
 * the work of the walls to *work [J]. With APIC the reaction includes the momentum that the prescribed velocity
 * replaces. smallest_mass: as in grid_advance [kg]. */
KERNEL(void, grid_constrain,
       (struct grid *g, enum transfer transfer, real smallest_mass, real impulse[DIM_MAX], real *work));

/* Moves the nodes of g: calls grid_advance and then grid_constrain, which describe transfer, dt_velocity,
 * smallest_mass, impulse and work. For a body that has no contact with bodies on other grids. */
static inline void grid_advance_and_constrain_nodes(struct grid *g, enum transfer transfer, real dt_velocity,
                                                    real smallest_mass, real impulse[DIM_MAX], real *work)
{
    grid_advance(g, transfer, dt_velocity, smallest_mass);
    grid_constrain(g, transfer, smallest_mass, impulse, work);
}

/* Divides the nodal momentum g->momentum, which the remapping of MUSL (second map of momentum from points to nodes) has
 * summed, by the nodal mass, in place: g->momentum becomes a velocity (Zeng et al. 2022, step 6). Nodes with a
 * prescribed velocity (walls) receive it; nodes lighter than smallest_mass [kg] get 0. */
KERNEL(void, grid_remapped, (struct grid *g, real smallest_mass));

/* ---- the mesh of the reference frame (mesh.h), any dimension ----------------------------------------------------- */

/* Sets the forces on all nodes of the mesh (mesh->grid.force) to 0. */
KERNEL(void, mesh_clear, (struct mesh *mesh));

/* Adds the internal forces of all cells of the mesh that are not at rest to the nodes. Marks the cells in which a point
 * may exceed its conversion stress (at which it becomes peridynamic), for mesh_points_mark. p: particles, with the
 * reactions of bonds on material points (p->end_*). If p has the arrays plastic_correction, points beyond the yield
 * stress flow, and their plastic state is updated (mesh_flow.h). Points of flow laws with mode LAW_EXPLICIT (for
 * explicit time steps) keep the state of the last mesh_points_flow instead. m: elastic constants by material. finite:
 * true for Biot strain in axes that rotate with the cell, false for the symmetric displacement gradient
 * (mesh_law.h). */
KERNEL(void, mesh_force, (struct mesh *mesh, const struct particles *p, const struct elastic *m, bool finite));

/* Integrates the motion of the active nodes of the mesh: v += dt_velocity f/m, u += dt v, with u rounded to multiples
 * of mesh->rounding. Nodes with a prescribed velocity (walls) receive it; the reactions at these nodes are added to
 * impulse[dim] [N s] and their work to *work [J]. Applies dashpots and adds their energy and impulse to
 * mesh->grid.absorbed. f becomes m dv/dt_velocity of each node. Returns the largest velocity component of a node [m/s];
 * INFINITY if a component is not finite. */
KERNEL(real, mesh_move, (struct mesh *mesh, real dt, real dt_velocity, real impulse[DIM_MAX], real *work));

/* Interpolates position and velocity of all material points of the mesh from the nodes of the mesh, and stores them in
 * p. */
KERNEL(void, mesh_points_move, (const struct mesh *mesh, struct particles *p));

/* Interpolates position and velocity from the nodes of the mesh into p, for the exposed points (mesh->exposed_list):
 * points with bonds or loads, whose motion other parts of a run need in every step. */
KERNEL(void, mesh_exposed_move, (const struct mesh *mesh, struct particles *p));

/* Interpolates position and velocity from the nodes of the mesh into p, for those of the particles list[n] (indices)
 * that are material points of the mesh. */
KERNEL(void, mesh_listed_move, (const struct mesh *mesh, struct particles *p, const int32_t *list, int64_t n));
/* Adds the forces p->f on the exposed points (mesh->exposed_list: points with bonds or loads) to the nodes of the mesh,
 * by their interpolation weights. Serial. */
KERNEL(void, mesh_exposed_force, (struct mesh *mesh, const struct particles *p));
/* Computes Cauchy stress [Pa] and volume [m^3] of all material points of the mesh into p. m: elastic constants by
 * material; finite: true for finite strain, false for small strain. */
KERNEL(void, mesh_points_stress, (const struct mesh *mesh, struct particles *p, const struct elastic *m, bool finite));
/* Updates the plastic state of all material points of the mesh whose flow law has mode LAW_EXPLICIT (for explicit time
 * steps), for a step of dt [s] that has ended with the present displacements. p->mesh_stress contains the stresses of
 * the points at the start of the step and receives the stresses at its end. With dt = 0, before the first step,
 * p->mesh_stress receives the stresses of the present displacements, and no point yields. m: elastic constants by
 * material; finite: true for finite strain, false for small strain. */
KERNEL(void, mesh_points_flow, (const struct mesh *mesh, const struct particles *p, const struct elastic *m, real dt,
                                bool finite));
/* Computes the displacement gradient du_a/dX_b [1] of every material point i of the mesh into to[a dim + b][i], i being
 * the index of the particle. */
KERNEL(void, mesh_points_gradient, (const struct mesh *mesh, real *const *to));
/* Sets FLAG_STRESSED on material points of the mesh (particles of p) whose largest principal stress exceeds their
 * conversion stress (at which they become peridynamic), in the cells that the last mesh_force marked as `stressed`. m:
 * elastic constants by material; finite: true for finite strain, false for small strain. */
KERNEL(void, mesh_points_mark, (const struct mesh *mesh, struct particles *p, const struct elastic *m, bool finite));

/* Sets mark[cell] = 1 for whole cells of the mesh (with all points, of one material, without bonds) in which the
 * principal stress of a point may exceed `share` [1] times the conversion stress (at which it becomes peridynamic);
 * other entries are not changed. mark: [grid.n], indexed by cell; all: true to examine all such cells, false only those
 * that the last mesh_force marked as `stressed`; m: elastic constants by material; finite: true for finite strain,
 * false for small strain. */
KERNEL(void, mesh_cells_mark, (const struct mesh *mesh, const struct elastic *m, real share, bool all, uint8_t *mark,
                               bool finite));

/* Computes nodal velocities of a mesh of coarse cells, `to`, from the momentum of its nodes divided by their mass,
 * `from`, both [dim][grid.n] [m/s], with the mass matrix blended of lumped and consistent mass (mesh_inertia.c). */
KERNEL(void, mesh_velocity, (const struct mesh *mesh, real *const *from, real *const *to));

/* Returns the kinetic energy [J] of the mesh: the sum of m v^2/2 over its nodes, with nodal masses m and velocities
 * v. */
KERNEL(real, mesh_kinetic, (const struct mesh *mesh));

/* Returns the correction [J] of the kinetic energy of the mesh for leap-frog velocities, which are half a step behind
 * the positions: the sum of (dt f)^2/(4 m) over the nodes, with the force f and the mass m of a node. dt: time step
 * [s]. */
KERNEL(real, mesh_kick, (const struct mesh *mesh, real dt));
/* Returns the elastic energy [J] of all cells of the mesh, including their contribution to the neighbourhoods of bonded
 * points (material points of p with state-based bonds). m: elastic constants by material; finite: true for finite
 * strain, false for small strain. */
KERNEL(real, mesh_strain, (const struct mesh *mesh, const struct particles *p, const struct elastic *m, bool finite));
/* Computes p->end_strain and p->end_rotation, strain and rotation of the material points of the mesh with state-based
 * bonds to peridynamic particles, from the deformation of their cells. finite: true for finite strain, false for small
 * strain. */
KERNEL(void, mesh_ends_update, (const struct mesh *mesh, struct particles *p, bool finite));

#endif

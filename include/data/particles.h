/* Room `data` (folder of include/ and src/): the contents of a body: particles, search cells, grids, materials,
 * regions, the active set. It has structures and the functions that keep them consistent, no physics. It uses `base`;
 * every other room may call it.
 *
 * This header: particles of both kinds as a structure of arrays, and the table that describes every array.
 *
 * Layout: entries 0 .. n-1 are the particles of the bodies, sorted row by row (x fastest), so that neighbours on the
 * lattice are near in memory. Entries n .. n_all-1 are mirror images of some of them (struct image), which bonds read
 * and which are never integrated. Arrays have LANES more entries, so that whole vectors can be loaded anywhere. */
#ifndef CLEAVE_PARTICLES
#define CLEAVE_PARTICLES

#include <math.h>

#include "base/archive.h"
#include "base/base.h"
#include "material.h"

#define LATTICE_NEAR 1e-8 /* largest deviation of a lattice particle from its site [spacings] */
enum { LANES = 8 };       /* particles that a vector instruction treats at once: 8 double numbers */
enum { ROTATION = 4 };    /* numbers that store a rotation in 3D (a quaternion) */

/* Kinds of particles: material point, peridynamic particle; KINDS is their number. */
enum kind { KIND_MPM, KIND_PD, KINDS };

/* Bits of the array `flag` of struct particles, whose entry is the sum of all bits that apply to the particle.
 * convert_flagged_points_to_peridynamic, which turns material points into peridynamic particles at the end of a step,
 * clears FLAG_LOST_BOND, FLAG_CRACKED, FLAG_STRESSED and FLAG_NEAR. */
enum particle_flag {
    FLAG_LOST_BOND = 1,     /* lost a bond in this step */
    FLAG_STRESSED = 2,      /* largest principal stress exceeds that at which material points become peridynamic */
    FLAG_DRIVEN = 4,        /* a boundary condition prescribes a component of the motion */
    FLAG_CRACKED = 8,       /* in this step, lost a bond of which neither particle has FLAG_DRIVEN */
    FLAG_GRID_COUPLED = 16, /* peridynamic, but moved by the grid (grid_coupled.h) */
    FLAG_MESHED = 32,       /* material point of the mesh of the reference frame (mesh.h) */
    FLAG_LISTED = 64,       /* is in the list of particles to convert, under construction in conversion.c */
    FLAG_NEAR = 128         /* material point near another body (approach.h) */
};

/* Material points and peridynamic particles of all bodies in dim dimensions, as a structure of arrays, which it
 * owns. */
struct particles {
    int64_t n, n_all;                    /* number of particles of the body; of these and their mirror images */
    int64_t n_body;                      /* n and the number of particles of the body that are not created (hollow.h) */
    real low[DIM_MAX], high[DIM_MAX];    /* extent of the reference positions, if some particles are not created [m] */
    int dim;                             /* number of coordinates, 1 to 3 */
    const struct material *plane_strain; /* [materials] of a body in plane strain, borrowed; NULL in other spaces */
    int64_t n_of[KINDS];                 /* number of particles of each kind */
    int64_t n_grid_coupled;              /* peridynamic particles moved by the grid */
    int32_t *list[KINDS]; /* [n_of] indices of each kind, ascending; rebuilt by particles_rebuild_lists_by_kind */
    int64_t n_free;     /* number of material points on the background grid (not in the mesh of the reference frame) */
    int32_t *list_free; /* [n_free] indices of these points, ascending */
    /* Every array below has n_all + LANES entries, indexed by particle. */
    real *X[DIM_MAX];       /* reference position [m] */
    real *x[DIM_MAX];       /* present position [m] */
    real *v[DIM_MAX];       /* velocity half a time step before that of x [m/s] */
    real *f[DIM_MAX];       /* sum of bond forces and applied forces [N] */
    real *mass;             /* mass of the particle [kg] */
    real *volume0, *volume; /* reference and current volume [m^3] */
    /* Cauchy stress, components xx yy xy in 2D, xx yy zz xy yz zx in 3D [Pa]. Points on the grid: updated by g2p in
     * every step. Points of a mesh: updated by lagrangian_mesh_update_point_motion_and_stress, peridynamic particles:
     * by bonds_compute_particle_stress, for frames (run_update_particle_motion_and_stress) and for samples and
     * reversion that read it; out of date in between. */
    real *stress[SYM_MAX];
    real *gradient[DIM_MAX *
                   DIM_MAX]; /* velocity gradient dv_a/dx_b at [a dim + b], only APIC (Jiang et al. 2015) [1/s] */
    real *stretch[DIM_MAX];  /* edge of the particle along each axis divided by the initial edge, only cpGIMP [1] */
    /* only if a material yields: accumulated equivalent plastic strain [1]; plastic work per reference volume, booked
     * step by step (laws/law_update.h) [J/m^3] */
    real *plastic_strain, *plastic_work;
    real *out_of_plane; /* sigma_zz - nu (sigma_xx + sigma_yy), only with WITH_OUT_OF_PLANE [Pa] */
    /* points of a mesh: plastic stress correction, C : strain minus the stress, in axes that rotate with the cell of
     * the point; only with WITH_PLASTIC_CORRECTION [Pa] */
    real *plastic_correction[SYM_MAX];
    real *back_stress[SYM_MAX]; /* deviatoric, of kinematic hardening; only with WITH_BACK_STRESS [Pa] */
    real *temperature;          /* only with WITH_TEMPERATURE [K] */
    /* points of a mesh with a flow law: stress at the end of the last step, in axes that rotate with the cell of the
     * point; only with WITH_MESH_STRESS [Pa] */
    real *mesh_stress[SYM_MAX];
    /* bonded material points (with state-based bonds): contribution of their cell to the mean strain S of their
     * neighbourhood [1] */
    real *end_strain;
    /* rotation R of bonded points: in 2D cos - 1 and sin, in 3D a quaternion, its scalar last; only models with
     * rotations [1] */
    real *end_rotation[ROTATION];
    /* reaction of the bonds on bonded points: derivative of the energy of their neighbourhood (all neighbours of a
     * point) by end_strain [J] */
    real *end_pull;
    real *end_moment[DIM_MAX]; /* moment of the bonds about bonded points, in axes that rotate with the points [N m] */
    real *low_since; /* peridynamic particles: time since which the stress is low, INFINITY: it is not low; only with
                        WITH_REVERSION [s] */
    real *strength;  /* random factor on the critical stretch; only with WITH_STRENGTH [1] */
    real *damage;    /* share of broken bonds, 0 .. 1 [1] */
    uint8_t *kind, *material, *body, *flag; /* enum kind; index of the material and of the body; sum of FLAG_* */
    uint8_t *reversions;                    /* number of reversions to a material point; only with WITH_REVERSION */
    int32_t *id;                            /* index in the order in which the scene made the particles */
};

/* Origin of a mirror image. Entry n + k of the particle arrays is the image number k: the copy of particle `source`
 * (which may be an image, too) beyond the plane of symmetry that boundary condition number `load` describes. */
struct image {
    int32_t source;
    uint8_t load;
};

/* Returns the eight bytes bytes[0] .. bytes[7] as one 64-bit number, in the byte order of the machine. */
static inline uint64_t eight_bytes_as_word(const uint8_t *bytes)
{
    uint64_t eight;
    memcpy(&eight, bytes, sizeof eight);
    return eight;
}

/* The 64-bit number whose eight bytes are all equal to `byte`. */
#define EIGHT_TIMES(byte) ((uint64_t)(byte)*0x0101010101010101)

/* Returns true if the eight bytes bytes[0] .. bytes[7] are all equal. */
static inline bool eight_bytes_are_equal(const uint8_t *bytes)
{
    return eight_bytes_as_word(bytes) == EIGHT_TIMES(bytes[0]);
}

/* Returns the index of the first entry of mark[count], from `first` on, that is not 0, or `count` if there is none.
 * mark must have LANES more entries, all 0, because eight entries are tested at a time. */
static inline int64_t next_marked_index(const uint8_t *mark, int64_t first, int64_t count)
{
    while (first < count && !mark[first])
        if (eight_bytes_as_word(mark + first))
            first++;
        else
            first += LANES;
    return first < count ? first : count;
}

/* Sets bit i of the bit array `marks`. */
static inline void bit_set(uint64_t *marks, int64_t i) { marks[i / 64] |= (uint64_t)1 << i % 64; }

/* Clears bit i of the bit array `marks`. */
static inline void bit_clear(uint64_t *marks, int64_t i) { marks[i / 64] &= ~((uint64_t)1 << i % 64); }

/* Returns true if bit i of the bit array `marks` is set. */
static inline bool bit_is_set(const uint64_t *marks, int64_t i) { return marks[i / 64] >> i % 64 & 1; }

/* Returns how many of the eight indices first .. first + 7 are below `limit`. */
static inline int count_of_next_eight_indices_below_limit(int64_t first, int64_t limit)
{
    return limit - first < LANES ? (int)(limit - first) : LANES;
}

/* Returns the index of the particle of which entry i of the arrays of p is a mirror image (copy beyond a plane of
 * symmetry), possibly through images of images; i itself if it is no image. image[k]: origin of entry p->n + k. */
static inline int64_t mirror_image_source_particle(const struct particles *p, const struct image *image,
                                                   int64_t particle)
{
    while (particle >= p->n) particle = image[particle - p->n].source;
    return particle;
}

/* Bits of the arguments `optional_arrays` of the functions below. Each bit stands for some optional arrays of struct
 * particles; the comment on such an array names its bit. */
enum {
    WITH_GRADIENT = 1,
    WITH_STRETCH = 2,
    WITH_PLASTIC = 4,
    WITH_OUT_OF_PLANE = 8,
    WITH_REVERSION = 16,
    WITH_ENDS = 32,
    WITH_ROTATIONS = 64,
    WITH_STRENGTH = 128,
    WITH_PLASTIC_CORRECTION = 256,
    WITH_BACK_STRESS = 512,
    WITH_TEMPERATURE = 1024,
    WITH_MESH_STRESS = 2048,
    WITH_EVERYTHING = 4095
};

/* Description of one array of struct particles, or of one array per component. Loops over a table of these descriptions
 * allocate, release, sort, save and restore all arrays. */
struct particle_field {
    const char *name, *unit, *meaning; /* name in checkpoints; unit; description */
    size_t offset, size;               /* offset of the (first) array pointer in struct particles; entry size [byte] */
    int (*count)(int dim, int optional); /* number of component arrays in dimension dim */
    bool in_trials; /* plastic state, which is also saved before trial equilibria (ARCHIVE_TRIAL) */
};
extern const struct particle_field particle_fields[];
extern const int particle_fields_count;

/* Returns the array of component number `component` of field f of the particles p, for example component 1 of the
 * velocity for velocities along y; NULL if an optional field is not allocated. */
void *particle_field_array(const struct particles *p, const struct particle_field *f, int component);

/* Saves the arrays of p, mirror images (copies beyond planes of symmetry) included, to the archive `a` if a->saving,
 * else restores them. If a->scope is not ARCHIVE_ALL (the state for a restart), only the plastic state of particles is
 * saved or restored. optional_arrays: optional arrays of p, sum of WITH_*. Returns FAILED if the archive cannot be read
 * or written or a stored size differs. */
status particles_save_or_load(struct particles *p, int optional_arrays, struct archive *a);

/* Copies the reference position of particle i of p to X (p->dim components [m]). */
static inline void particle_reference_position(const struct particles *p, int64_t i, real *X)
{
    for (int d = 0; d < p->dim; d++) X[d] = p->X[d][i];
}

/* A position or another vector as text, for messages: `position_text(X, dim, 4).text` is valid until the end of the
 * statement in which it is called. */
struct position_text {
    char text[DIM_MAX * 24];
};

/* Returns the components X[0] .. X[dim - 1] of a vector as text, separated by ", ". digits: significant digits of each
 * component. */
struct position_text position_text(const real *X, int dim, int digits);

/* Returns the reference position [m] of particle i of p as text, coordinates separated by ", ". digits: significant
 * digits of each coordinate. */
struct position_text particle_position_text(const struct particles *p, int64_t i, int digits);

/* Returns the random factor [1] on the critical stretch of the bond between particles i and j of p: the smaller of the
 * strength factors of both particles; 1 if strength is uniform. Weibull's distribution is closed under the minimum
 * (weakest link), so bonds, and chains of bonds, have its modulus too. */
static inline real bond_strength_factor(const struct particles *p, int64_t i, int64_t j)
{
    return p->strength ? (p->strength[i] < p->strength[j] ? p->strength[i] : p->strength[j]) : 1;
}

/* Returns the ratio of the stored stress of particle i of p to the stress on the strength surface of its material that
 * has the same direction: 1 on the surface, where the material fails; 0 if the material has no such surface. material:
 * materials of the scene, indexed by p->material[i]; space: determines the stress normal to a plane. */
static inline real particle_stress_to_strength_ratio(const struct particles *p, const struct material *material,
                                                     enum space space, int64_t i)
{
    const struct material *m = &material[p->material[i]];
    real stress[SYM_MAX];
    for (int s = 0; s < symmetric_tensor_component_count(p->dim); s++) stress[s] = p->stress[s][i];
    return material_has_strength_surface(m) ? material_stress_to_strength_ratio(m, space, stress) : 0;
}

/* Returns true if particle i of p moves with the nodes of the grid or mesh: it is a material point, or a peridynamic
 * particle that the grid moves. */
static inline bool particle_is_moved_by_grid_or_mesh_nodes(const struct particles *p, int64_t i)
{
    return p->kind[i] == KIND_MPM || (p->flag[i] & FLAG_GRID_COUPLED);
}

/* Returns the stress sigma_zz [Pa] of particle i of p in plane strain, nu (sigma_xx + sigma_yy) plus a part due to
 * plastic flow; 0 in plane stress, in 1D and in 3D. For material points on a mesh of the undeformed body the relative
 * error of this stress is of the order of the strain. For peridynamic particles that were material points before, the
 * plastic part is that of the time at which they became peridynamic. */
static inline real particle_out_of_plane_stress(const struct particles *p, int64_t particle)
{
    if (!p->plane_strain) return 0;
    const real flow = p->out_of_plane ? p->out_of_plane[particle] : 0;
    return p->plane_strain[p->material[particle]].poisson * (p->stress[0][particle] + p->stress[1][particle]) + flow;
}

/* Allocates the arrays of p for `particle_count` particles in `dim` dimensions without mirror images (copies of
 * particles beyond planes of symmetry); all values are 0. optional_arrays: arrays that are allocated besides the usual
 * ones, sum of WITH_*. Release with particles_free. */
void particles_make(struct particles *p, int dim, int64_t particle_count, int optional_arrays);

/* Extends every array of p by `image_count` zeroed entries for mirror images (copies of particles beyond planes of
 * symmetry), behind the entries of the body; pointers to the arrays change. optional_arrays: optional arrays of p, sum
 * of WITH_*. Called once, at set-up. */
void particles_extend_arrays_for_mirror_images(struct particles *p, int64_t image_count, int optional_arrays);

/* Releases all arrays of the particles p. */
void particles_free(struct particles *p);

/* Copies all fields of those particles of `previous` that p has, too, to their entries in p, which must be allocated.
 * new_index: [previous->n] new index of each particle in p, -1: the particle is not in p. optional_arrays: optional
 * arrays of both, sum of WITH_*. */
void particles_copy_fields_by_new_index(struct particles *p, const struct particles *previous, const int32_t *new_index,
                                        int optional_arrays);

/* Sorts the particles of p row by row: by z, then y, then x, where z and y are rounded to rows of thickness `spacing`
 * [m]; equal positions by id. optional_arrays: optional arrays of p, sum of WITH_*. Called at set-up, before mirror
 * images are added. */
void particles_sort_by_lattice_rows(struct particles *p, real spacing, int optional_arrays);

/* Computes the smallest coordinate *low and the largest *high [m] along axis `axis` of the reference positions of the
 * first `count` particles of p; INFINITY and -INFINITY if `count` = 0. If `count` is p->n, the range also includes
 * particles of the body that were not created because they are inside coarse mesh cells (data/hollow.h). */
void particles_coordinate_range(const struct particles *p, int64_t count, int axis, real *low, real *high);

/* Returns the index of the particle of p whose reference position is nearest to X (p->dim components [m]), of several
 * the lowest index. Mirror images are not considered. */
int64_t particles_index_nearest_to_position(const struct particles *p, const real *X);

/* Returns the largest speed [m/s] of the particles of p in particle_list[particle_count] (indices); 0 for an empty
 * list. */
real particles_largest_speed_of_list(const struct particles *p, const int32_t *particle_list, int64_t particle_count);

/* Returns the largest speed [m/s] of all particles of p, peridynamic particles and material points. */
real particles_largest_speed_of_all(const struct particles *p);

/* Returns the longest edge [m] of the bounding box of the reference positions of all particles of p, without mirror
 * images. */
real particles_bounding_box_longest_edge(const struct particles *p);

/* Returns the volume [m^3] of a particle of a lattice: section times spacing^dim. cross_section: cross-section in 1D
 * [m^2], thickness in 2D [m], 1 in 3D; spacing: lattice spacing [m]. All callers use this function, so that the
 * quotient of two such volumes is exactly 1. */
static inline real lattice_particle_volume(real cross_section, real spacing, int dim)
{
    real volume = cross_section;
    for (int d = 0; d < dim; d++) volume *= spacing;
    return volume;
}

/* Returns true if `coordinate` is a whole number of spacings away from `origin`, with a tolerance of LATTICE_NEAR
 * spacings. *site receives the nearest whole number of spacings in any case. coordinate, origin, spacing: in the same
 * unit. */
static inline bool lattice_contains_coordinate(real coordinate, real origin, real spacing, real *site)
{
    const real k = (coordinate - origin) / spacing;
    *site = nearbyint(k);
    return fabs(k - *site) <= LATTICE_NEAR;
}

/* Rebuilds the particle lists of p: the particles of each kind (n_of, list) from p->kind, and the material points on
 * the background grid (n_free, list_free) from p->kind and p->flag. */
void particles_rebuild_lists_by_kind(struct particles *p);

/* Returns true if at least one particle of p is flagged for conversion from material point to peridynamic particle: it
 * has lost a bond, has a large stress, or is near another body (FLAG_LOST_BOND, FLAG_STRESSED, FLAG_NEAR). */
bool particles_any_is_flagged_for_conversion(const struct particles *p);

#endif

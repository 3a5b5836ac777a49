/* Declarations shared by the files surface_*.c, which correct the weights of bonds near faces of lattice bodies: the
 * particles near faces, their neighbours, properties of faces, and classes of particles with equal surroundings. */
#ifndef CLEAVE_SURFACE_PARTS
#define CLEAVE_SURFACE_PARTS

#include "bonds/bonds.h"
#include "bonds/surface.h"

/* The neighbours of a particle inside a lattice, as lattice vectors (offsets) from the particle in a fixed order.
 * "Offset number k" in other comments is the index k of these arrays. All arrays are owned. */
struct offsets {
    /* number of neighbours; dimension; largest component [spacings] */
    int n, dim, reach;
    /* [n] components [spacings], ascending (the negative of number k is n - 1 - k) */
    int (*at)[DIM_MAX];
    /* [n] length [spacings]; unit vector along the offset; share: factor on the stiffness of a bond, as struct bonds
     * stores it [1]; weight: force divided by stretch, in state-based models share times length */
    real *length, (*direction)[DIM_MAX], *share, *weight;
    int axis[DIM_MAX][2]; /* index of the nearest neighbour down and up an axis */
    int32_t *number;      /* [(2 reach + 1)^dim] index of an offset, -1: none */
    int32_t *mirrored;    /* [2^dim n] index of an offset reflected in mirrors, one bit per axis */
};

/* The n particles of p near faces, i.e. particles with a missing neighbour and neighbours of such particles, with all
 * their neighbours by offset (lattice vector from particle to neighbour). source: inputs of the bonds. */
struct particles_near_faces {
    const struct particles *p;
    const struct bond_source *source;
    struct offsets offset;
    int64_t n;
    int32_t *particle;  /* [n] ascending */
    int32_t *place;     /* [p->n] index in `particle`, -1: no face nearby */
    int32_t *neighbour; /* [n offsets] particle or mirror image; -1: none, or cut by a crack */
    uint8_t *whole;     /* [p->n] 1: no neighbour is missing */
};

/* A particle of the body, and the axes that mirrors reverse between it and the particle or mirror image that this
 * struct describes. particle: index of the particle of the body; mirrors: bit d is set if axis d is reversed. */
struct mirrored_particle {
    int64_t particle;
    int mirrors;
};

/* Returns the source of the mirror image `image` (a copy beyond a plane of symmetry; index of the particle arrays): a
 * particle of the body, possibly through several mirrors, with the axes that these mirrors reverse (bit d: axis d).
 * near_faces: particles near faces. */
struct mirrored_particle mirror_image_find_source_and_reversed_axes(const struct particles_near_faces *near_faces,
                                                                    int64_t image);

/* Returns the particle of the body that belongs to entry `entry` of the particle arrays: `entry` itself or, for a
 * mirror image (copy beyond a plane of symmetry), the particle that it mirrors, with the axes that the mirrors in
 * between reverse (bit d: axis d). near_faces: particles near faces. */
static inline struct mirrored_particle
particle_or_image_find_source_and_reversed_axes(const struct particles_near_faces *near_faces, int64_t entry)
{
    return entry < near_faces->p->n ? (struct mirrored_particle){entry, 0}
                                    : mirror_image_find_source_and_reversed_axes(near_faces, entry);
}

/* Returns the sign that the mirrors `mirrors` (bit d: they reverse axis d) give a vector component along axis `axis`:
 * -1 if they reverse that axis, else 1. */
static inline real mirror_sign_of_vector_component(int mirrors, int axis) { return mirrors >> axis & 1 ? -1 : 1; }

/* Returns the particle or mirror image that is offset number `offset_number` (an index into the arrays of
 * near_faces->offset, the relative positions of neighbours on the lattice) away from
 * near_faces->particle[particle_number]; -1 if there is none or the bond is cut. */
static inline int32_t particles_near_faces_neighbour_at_offset(const struct particles_near_faces *near_faces,
                                                               int64_t particle_number, int offset_number)
{
    return near_faces->neighbour[particle_number * near_faces->offset.n + offset_number];
}

/* Returns the neighbour at offset number `offset` (a lattice vector) of `from`, a particle near faces `near_faces` or
 * its mirror image: the particle of the body, and the axes that mirrors reverse between it and this neighbour. The
 * member `particle` of the result is -1 if there is no neighbour or the bond is cut. */
static inline struct mirrored_particle
mirrored_particle_neighbour_at_offset(const struct particles_near_faces *near_faces,
                                      const struct mirrored_particle *from, int offset)
{
    const int32_t own = near_faces->offset.mirrored[from->mirrors * near_faces->offset.n + offset];
    const int32_t j = particles_near_faces_neighbour_at_offset(near_faces, near_faces->place[from->particle], own);
    if (j < 0) return (struct mirrored_particle){-1, 0};
    struct mirrored_particle to = particle_or_image_find_source_and_reversed_axes(near_faces, j);
    to.mirrors ^= from->mirrors;
    return to;
}

/* Returns true if no neighbour of entry j of the particle arrays is missing, so that no face is near. If j is a mirror
 * image (copy beyond a plane of symmetry), its source particle is examined. near_faces: particles near faces. */
static inline bool particle_family_is_complete(const struct particles_near_faces *near_faces, int64_t particle_or_image)
{
    return near_faces
        ->whole[particle_or_image < near_faces->p->n
                    ? particle_or_image
                    : mirror_image_source_particle(near_faces->p, near_faces->source->image, particle_or_image)];
}

/* Returns the offset number (index of a lattice vector in near_faces->offset) of a bond as seen from its second
 * particle: the opposite of offset number `offset`, by which the first particle sees the bond. other_particle: the
 * second particle; where it is a mirror image, the vector is also reflected at the mirror. */
int bond_offset_seen_from_other_particle(const struct particles_near_faces *near_faces,
                                         const struct mirrored_particle *other_particle, int offset);

/* Lists in `near_faces` the particles of p near faces (with a missing neighbour, or beside such a particle) and all
 * their neighbours. source: inputs of the bonds (horizon, materials, cracks, mirrors). Returns REFUSED, with a message,
 * if the particles are not on a lattice; unfitting_pair[0] is then the first particle with a neighbour that is not a
 * whole number of spacings away, unfitting_pair[1] this neighbour. Release with particles_near_faces_free. */
status particles_near_faces_list_with_neighbours(struct particles_near_faces *near_faces, const struct particles *p,
                                                 const struct bond_source *source, int64_t unfitting_pair[2]);

/* Releases all arrays of `near_faces`, the particles near faces. */
void particles_near_faces_free(struct particles_near_faces *near_faces);

/* Properties of the faces near each particle [n], from which the targets for the weights (factors on the stiffness) of
 * its bonds follow (surface_fit.c). */
struct surface_fit_targets {
    real (*area)[DIM_MAX]; /* [n] area of the faces in the particle's cell times outward normal, extrapolated from
                              layers to the face [spacing^(dim-1)] */
    real *dipole; /* [n] required increase of the fourth moment of the bonds over that of a full neighbourhood, relative
                     to the latter and divided by a constant alpha of the model [1] */
    real (*normal2)[DIM_MAX][DIM_MAX]; /* [n] N (x) N of the face normal N, averaged over nearby faces; trace 1 at a
                                          plane face, less at smaller faces, 0 without a face nearby */
    uint8_t *thin;                     /* [n] too few layers between two faces: fewer than THIN or THIN_ROTATING */
};

/* Smallest number of particle layers between two faces with which a part of a body is not thin: THIN in models without,
 * THIN_ROTATING in models with rotations of the particles. */
enum { THIN = 4, THIN_ROTATING = 5 };

/* Computes into f, for each of the particles `near` near faces, the quantities to which the weights (factors on the
 * stiffness) of its bonds are fitted: face area with outward normal, increase of the fourth moment of the bonds, and
 * mean product of normals (members area, dipole, normal2). with_rotations: true for the modified state-based model, in
 * which particles rotate. Release with surface_fit_targets_free. */
void surface_fit_targets_compute_areas_and_moments(struct surface_fit_targets *f,
                                                   const struct particles_near_faces *near, bool with_rotations);

/* Releases all arrays of f, the targets of the fit of bond weights near faces. */
void surface_fit_targets_free(struct surface_fit_targets *f);

/* Classes of particles near faces whose neighbours have equal relative positions, up to reflections along axes, and
 * groups of bonds that share one factor on their weight; factors are stored by class and offset. */
struct bond_classes {
    int32_t classes, *class_of; /* [near n] class; 0 is not used (no face nearby) */
    uint8_t *mirrors; /* [near n] mirrors (one bit per axis) that map its surroundings to those of the first particle of
                         its class */
    int64_t *member;  /* [classes] first particle of the class, as index in particles_near_faces */
    real *members;    /* [classes] number of particles */
    uint8_t *symmetry; /* [classes] bit m: the class is its own image in mirrors m */
    int64_t groups;    /* number of groups of bonds */
    int64_t *group_of; /* [classes offsets] group; -1: no bond, or a bond that reaches no face */
};

/* Sorts the particles `near` near faces into classes with equal surroundings up to reflections along axes, and their
 * bonds into groups with one factor each. Release with bond_classes_free. */
void bond_classes_group_bonds_near_faces(struct bond_classes *classes, const struct particles_near_faces *near);

/* Returns the neighbour at offset number `offset_number` (a lattice vector) of the first particle of class number
 * `class` in `classes`: a particle or mirror image; -1 if there is none. The particles of a class (near faces, `near`)
 * have equal surroundings up to reflections, so the offset refers to the axes of the class, some of which may be
 * reversed at this particle. */
static inline int32_t bond_class_neighbour_of_first_particle_at_offset(const struct bond_classes *classes,
                                                                       const struct particles_near_faces *near,
                                                                       int32_t class, int offset_number)
{
    const int64_t t = classes->member[class];
    return particles_near_faces_neighbour_at_offset(
        near, t, near->offset.mirrored[classes->mirrors[t] * near->offset.n + offset_number]);
}

/* Releases all arrays of `classes`, the classes of particles near faces. */
void bond_classes_free(struct bond_classes *classes);

/* Number of third and fourth moments of a bond in 3D, and in 2D (_2D), each padded to an even number. MOMENTS: sum of
 * both in 3D. */
enum { THIRDS = 10, FOURTHS = 16, THIRDS_2D = 4, FOURTHS_2D = 6, MOMENTS = THIRDS + FOURTHS };

/* Data of a class of particles (with equal surroundings) in the least-squares fit of bond weights near faces. third,
 * fourth: inverses of the quadratic forms of its third and fourth moments, times the number of its particles; goal:
 * required sum of the moments of those bonds whose factors may change. */
struct class_fit {
    real third[THIRDS][THIRDS], fourth[FOURTHS][FOURTHS], goal[MOMENTS];
};

/* Least-squares problem for the factors f on the weights (stiffnesses relative to a full bond) of bonds near the
 * surface of a body. Bonds of a group share a factor; particles of a class have equal surroundings (alike). Minimise
 * the sum over classes of (M - goal) Q (M - goal) plus the sum over groups of prior (f - 1)^2 with low <= f <= high. M:
 * third and fourth moments of the bonds of a class, times f; goal: these moments of a complete neighbourhood; Q:
 * quadratic form of the class. */
struct surface_fit_problem {
    const struct bond_classes *alike;
    int offsets, thirds, fourths; /* neighbours of a full neighbourhood; third and fourth moments of a bond */
    const real *of;               /* [offsets (thirds + fourths)] moments of a bond */
    struct class_fit *class;      /* [classes] */
    int64_t *first, *entry;       /* [groups + 1] range of `entry`: entries (class, offset) by group */
    real *prior, *low, *high;     /* [groups] weight of (f - 1)^2; bounds of f, equal if f is given */
};

/* Upper limit of the number of matrix products in the solution of the least-squares problem
 * (surface_fit_solve_least_squares). Most bodies need 60 to 250, thin bodies with cracks in 3D 700. */
enum { SURFACE_PRODUCTS = 1000 };

/* Solves the least-squares problem q for the factors by Newton's method on its dual (surface_solve.c). factor: receives
 * the factors [groups]. max_matrix_products: largest number of products with the matrix of the dual problem; for large
 * bodies the function makes fewer, so that it takes at most about 10 s. Returns the remaining residual divided by the
 * residual with all factors 1: 0 for an exact fit. */
real surface_fit_solve_least_squares(const struct surface_fit_problem *q, real *factor, int max_matrix_products);

/* Computes the factors on the weights of all groups of bonds near faces by bounded least squares (surface_fit.c).
 * factor[classes->groups]: receives the factors [1]; near: particles near faces; targets: areas and moments to which
 * weights are fitted; classes: classes of particles and groups of bonds; with_rotations: true for the modified
 * state-based model, in which particles rotate; max_matrix_products: largest number of matrix products of the solver
 * (surface_fit_solve_least_squares). Returns the remaining residual divided by the residual with all factors 1. */
real surface_fit_compute_bond_weight_factors(real *factor, const struct particles_near_faces *near,
                                             const struct surface_fit_targets *targets,
                                             const struct bond_classes *classes, bool with_rotations,
                                             int max_matrix_products);

#endif

/* Voids of bodies narrower than a bond or a cell: slots, slits, gaps between solids of a shape. Two particles of a body
 * are connected if the segment between their reference positions is inside its shape. */
#ifndef CLEAVE_VOIDS
#define CLEAVE_VOIDS

#include "data/cells.h"
#include "data/particles.h"
#include "data/region.h"

/* Bits of the array voids.near, whose entry for a particle is the sum of the bits that apply. VOID_NEAR: a void is
 * between the particle and another particle of its body within reach; VOID_ACROSS: two surfaces of a void between them
 * face each other. */
enum {
    VOID_NEAR = 1,  /* a void hides a particle within reach */
    VOID_ACROSS = 2 /* ... and the faces on both sides of the void face each other */
};

/* Shapes of bodies with voids (slots, slits, gaps between solids), and marks of the particles near these voids. dim:
 * dimension of the bodies; shapes, mirrors: lengths of the lists below. */
struct voids {
    int dim, shapes;
    const struct region **shape;       /* [shapes] shapes of bodies with voids, borrowed */
    int *body;                         /* [shapes] number of the body in particles.body */
    const struct mirror_plane *mirror; /* [mirrors] planes beyond which bodies continue as images, borrowed */
    int mirrors;
    real spacing;  /* [m] */
    uint8_t *near; /* [particles and images] sum of VOID_NEAR, VOID_ACROSS */
};

/* Returns true if the region r contains a solid made from a voxel image, also within a group of solids; the surface of
 * such a solid is only known to about a voxel. */
bool region_has_voxel_image(const struct region *r);

/* Returns true if a void (a slot, a slit or a gap) may be between two points of the region r, the shape of a body.
 * Returns false if this is impossible: the shape is a single convex solid, boxes that together make one box, or the
 * intersection of convex solids, such as a quarter of a cylinder between the planes of symmetry of v. Returns false
 * also if r has no solids, or a solid made from a voxel image, whose surface is only known to about a voxel. */
bool region_may_have_voids(const struct region *r, const struct voids *v);

/* Computes v->near, which marks the particles of p that a void (a slot, a slit or a gap of the shape) separates from
 * others. All pairs of particles at most `max_distance` [m] apart are tested. The other members of v must be set
 * before. cells: search over reference positions; images: for each mirror image, the particle that it copies. Release
 * with voids_free. */
void voids_mark_particles_beside_voids(struct voids *v, const struct particles *p, const struct cells *cells,
                                       const struct image *images, real max_distance);

/* Returns true if the segment between `point` and `other_point` (v->dim components each [m]) leaves the shape of body
 * number `body_number`, so that a void is between the two points. Exchanging the points does not change the result.
 * surfaces_face_each_other: NULL, or receives, if there is a void, whether its two surfaces face each other. Gaps of up
 * to 2e-5 spacings are ignored. */
bool void_separates_points(const struct voids *v, int body_number, const real *point, const real *other_point,
                           bool *surfaces_face_each_other);

/* Returns true if a void (a slot, a slit or a gap of the shape) separates the particles `particle` and `other_particle`
 * of p, which are of one body, i.e. if the segment between their reference positions leaves the shape of the body. v:
 * NULL if no body has voids; the result is then false. Fast for particles that are not beside a void (v->near). */
bool void_separates_particles(const struct voids *v, const struct particles *p, int64_t particle,
                              int64_t other_particle);

/* Returns a lower bound [m] of the distance of the particle with index `particle` of p from the surface of the shape of
 * its body; the particle must be inside this shape. v: shapes of the bodies. */
real voids_particle_surface_distance_lower_bound(const struct voids *v, const struct particles *p, int64_t particle);

/* Returns true if a void (a slot, a slit or a gap of the shape) is beside particle i: it separates the particle from at
 * least one other of its body, within the distance given to voids_mark_particles_beside_voids. v: NULL if no body has
 * voids; the result is then false. */
static inline bool particle_is_beside_void(const struct voids *v, int64_t i) { return v && v->near[i]; }

/* Releases the arrays that v owns; shapes and mirror planes stay with their owners. */
void voids_free(struct voids *v);

#endif

/* Voids of bodies that are narrower than a bond is long or a cell wide: slots, slits, cracks between solids of a shape.
 * Two particles of a body see each other where the line between their reference positions lies in its shape. */
#ifndef CLEAVE_VOIDS
#define CLEAVE_VOIDS

#include "data/cells.h"
#include "data/particles.h"
#include "data/region.h"

/* Particles of a body, as bits of voids.near. */
enum {
    VOID_NEAR = 1,  /* a void hides a particle within reach */
    VOID_ACROSS = 2 /* ... and the faces on both sides of the void look at each other */
};

struct voids {
    int dim, shapes;
    const struct region **shape;       /* [shapes] solids of which bodies with voids consist, borrowed */
    int *body;                         /* [shapes] number that particles of the solid have in particles.body */
    const struct mirror_plane *mirror; /* [mirrors] planes beyond which bodies go on as images, borrowed */
    int mirrors;
    real spacing;  /* [m] */
    uint8_t *near; /* [particles and images] VOID_NEAR, VOID_ACROSS */
};

/* Has a region an image among its solids, or among those of its groups? The surface of images is not known exactly. */
bool region_has_image(const struct region *r);
/* Can a void lie between two places of the shape? False of a single convex solid, of an image, of no shape at all. */
bool region_has_voids(const struct region *r);

/* Fills v->near by a search of all pairs no farther apart than `reach` [m]; all else of v is set. `image`: sources of
 * images [p->n_all - p->n]. The caller frees v with voids_free. */
void voids_find(struct voids *v, const struct particles *p, const struct cells *cells, const struct image *image,
                real reach);
/* Does a void lie between places a and b of a body? Symmetric in a and b. *across (NULL: not asked): do its faces there
 * look at each other? Gaps of up to 2e-5 spacings are seams, as round-off leaves them: closed. */
bool voids_between(const struct voids *v, int body, const real *a, const real *b, bool *across);
/* Does a void lie between two particles of a body? v NULL: no. Quick for particles that have no void near. */
bool voids_part(const struct voids *v, const struct particles *p, int64_t i, int64_t j);
/* How deep particle i is in the shape of its body, at least [m]. */
real voids_depth(const struct voids *v, const struct particles *p, int64_t i);
/* Does a void hide a particle from particle i? v NULL: no. */
static inline bool voids_near(const struct voids *v, int64_t i) { return v && v->near[i]; }
void voids_free(struct voids *v);

#endif

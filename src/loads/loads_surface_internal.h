/* The surface of a load and its corners, shared by loads_surface.c and loads_corners.c. */
#ifndef CLEAVE_LOADS_SURFACE_INTERNAL
#define CLEAVE_LOADS_SURFACE_INTERNAL

#include "loads_surface.h"

/* Largest number of corners of the face of a particle: four, in 3D. */
enum { FACE_CORNERS = 4 };

/* The surface of one load: its faces, their corners, and the particles that move the corners. All arrays are owned. */
struct surface {
    int dim;
    real section, longest; /* thickness in 2D [m], 1 in 3D; a face with a longer edge is torn: it has no area [m] */
    int64_t faces, corners, particles; /* numbers of faces, of their corners, and of particles of the load */
    int32_t *corner; /* [faces][4] corners of each face, in order around the positive direction of its axis */
    int8_t *sign;    /* [faces] 1 or -1: factor by which area vectors in this order point outwards */
    uint8_t *turned; /* [first[corners]] bit d: component d of the displacement is reversed (image at a mirror) */
    int64_t *first, *face_first,
        *share_first;           /* ranges: [corners + 1] in particle, in `part`; [particles + 1] in share_corner */
    int32_t *particle;          /* [first[corners]] particles with which each corner moves */
    real *weight;               /* [first[corners]] weights of these particles [1] */
    int32_t *part;              /* [4 faces] faces that meet in each corner: 4 face + position of the corner in it */
    int32_t *share_corner;      /* [first[corners]] corners that move with each particle of the load */
    real *share_weight;         /* [first[corners]] weight of the particle for this corner [1] */
    uint8_t *share_turned;      /* [first[corners]] bits as in `turned` */
    real *place;                /* [corners][dim] reference positions [m] */
    real *x, *face_area, *area; /* working memory: [corners][dim], [faces][4][dim], [corners][dim] */
};

struct site; /* a lattice site with its particle (loads_corners.c) */

/* The lattice sites that particles occupy in all bodies with free faces of a load, and the planes of mirrors, from
 * which load_surface_compute_face_corners finds the corners of the faces. `site` is owned. */
struct lattice_sites {
    const struct particles *p;
    const struct boundary *all; /* boundaries of the scene, including mirrors */
    int boundaries;
    real spacing;
    int32_t first[UINT8_MAX + 1]; /* first particle of each body, -1: none */
    int64_t n;
    struct site *site; /* [n] sites with a particle, ascending by key */
};

/* Lists in s->site the lattice sites of the bodies with faces in `faces`, ascending by key, their number in s->n, and
 * the first particle of each body in s->first. The caller has set the other members of s, and cleared these. Returns
 * REFUSED, with a message, if a particle of these bodies is on no lattice, or if a mirror plane near a face is not
 * midway between two lattice sites. Release s->site with memory_free, also after a refusal. */
status lattice_sites_list_of_bodies_with_faces(struct lattice_sites *s, const struct surface_faces *faces);

/* Makes the corners of `faces` in the surface a: their numbers in a->corner, the faces that meet in each, the particles
 * that move each with their weights, and the reference positions. a->dim must be set and the arrays of corners not yet
 * allocated. s: lattice sites, from lattice_sites_list_of_bodies_with_faces. */
void load_surface_compute_face_corners(struct surface *a, const struct lattice_sites *s,
                                       const struct surface_faces *faces);

#endif

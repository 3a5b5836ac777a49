/* What the files surface_*.c share: particles near faces, their neighbours, their faces, their classes. */
#ifndef CLEAVE_SURFACE_PARTS
#define CLEAVE_SURFACE_PARTS

#include "bonds/bonds.h"
#include "bonds/surface.h"

/* Neighbours of a full family: components in spacings, ascending (the negative of number k is n - 1 - k); length
 * [spacings], direction, share as rows store it, and weight: force over stretch, which in state-based models is share
 * times length. */
struct offsets {
    int n, dim, reach;
    int (*at)[DIM_MAX];
    real *length, (*direction)[DIM_MAX], *share, *weight;
    int axis[DIM_MAX][2]; /* number of the nearest neighbour down and up an axis */
    int32_t *number;      /* [(2 reach + 1)^dim] of an offset, -1: none */
    int32_t *mirrored;    /* [2^dim n] number of an offset seen in mirrors: a bit for each axis */
};

/* Particles whose family is not whole, or that have a neighbour of which this is true. */
struct near_faces {
    const struct particles *p;
    const struct bond_source *source;
    struct offsets offset;
    int64_t n;
    int32_t *particle;  /* [n] ascending */
    int32_t *place;     /* [p->n] in that list, -1: no face nearby */
    int32_t *neighbour; /* [n offsets] particle or image; -1: none, or cut by a crack */
    uint8_t *whole;     /* [p->n] no neighbour is missing */
};

/* A neighbour: a particle of the body, and the mirrors between: a bit for each axis that they reverse. */
struct seen {
    int64_t particle;
    int mirrors;
};
struct seen seen_of(const struct near_faces *b, int64_t j);
static inline real mirror_sign(int mirrors, int axis) { return mirrors >> axis & 1 ? -1 : 1; }
static inline int32_t neighbour_of(const struct near_faces *b, int64_t t, int k)
{
    return b->neighbour[t * b->offset.n + k];
}
/* Neighbour at offset k of one that is near faces, with the mirrors up to it; its particle is -1: none, or cut off. */
struct seen seen_beyond(const struct near_faces *b, const struct seen *from, int k);
static inline bool is_whole(const struct near_faces *b, int64_t j)
{
    return b->whole[j < b->p->n ? j : image_root(b->p, b->source->image, j)];
}
/* The same bond in the row of its other end: number of the offset there. */
int twin_offset(const struct near_faces *b, const struct seen *to, int k);

/* REFUSED: not on a lattice; apart: the first particle with a neighbour that is not whole spacings away, and that. */
status near_faces_make(struct near_faces *b, const struct particles *p, const struct bond_source *s, int64_t apart[2]);
void near_faces_free(struct near_faces *b);

/* What faces ask of the particles near them. */
struct faces {
    real (*area)[DIM_MAX];             /* [n] outward, extrapolated to the face [spacing^(dim-1)] */
    real *dipole;                      /* [n] tau over alpha [1] */
    real (*normal2)[DIM_MAX][DIM_MAX]; /* [n] N (x) N, the mean over faces nearby, of trace 1 at a face; 0 without */
    uint8_t *thin;                     /* [n] too few layers between two faces: fewer than THIN or THIN_ROTATING */
};
enum { THIN = 4, THIN_ROTATING = 5 };
void faces_make(struct faces *f, const struct near_faces *b, bool rotates);
void faces_free(struct faces *f);

/* Particles of alike surroundings, but for mirrors, and bonds that are to have one factor: classes of particles have it
 * by offset. */
struct alike {
    int32_t classes, *class_of; /* [near n]; 0 is not used: no face nearby */
    uint8_t *mirrors;           /* [near n] in which the particle looks like its class */
    int64_t *member;            /* [classes] the first of its particles, by place in near_faces */
    real *members;              /* [classes] how many there are */
    uint8_t *symmetry;          /* [classes] bit m: in mirrors m it looks as without */
    int64_t groups;             /* of bonds */
    int64_t *group_of;          /* [classes offsets]; -1: no bond, or none that reaches a face */
};
void alike_make(struct alike *a, const struct near_faces *b);
/* Neighbour of a class at an offset: that of its first member; -1: none. */
static inline int32_t alike_neighbour(const struct alike *a, const struct near_faces *b, int32_t class, int k)
{
    const int64_t t = a->member[class];
    return neighbour_of(b, t, b->offset.mirrored[a->mirrors[t] * b->offset.n + k]);
}
void alike_free(struct alike *a);

/* Factors of all groups of bonds (surface_fit.c). */
void surface_fit(real *factor, const struct near_faces *b, const struct faces *f, const struct alike *a, bool rotates);

#endif

/* Declarations shared by the files of the crack tips: limits of distance, the extent of cracks, and the search for
 * particles near a position. */
#ifndef CLEAVE_TIPS_PARTS
#define CLEAVE_TIPS_PARTS

#include "fracture/tips.h"

enum { TIP_BEFORE = 255 }; /* label of particles damaged by a pre-crack */

#define TIP_TOUCH 1.5       /* distance within which particles of one crack touch [spacings] */
#define TIP_START_REACH 2.5 /* range of the first damaged particles from the end of a pre-crack [spacings] */
#define TIP_EQUAL 1e-6      /* tolerance of equal lengths [spacings] */

/* Number of entries of the list of peridynamic particles that are tested together. Most parts of the list have no
 * damaged particle and no particle of a crack, so that a whole part can be skipped at once. */
enum { TIP_PIECE = 64 };

/* Returns the end (index after the last entry) of the part of the list of peridynamic particles of p that begins at
 * entry `chunk_start`: piece_start + TIP_PIECE, or the length of the list if that is smaller. The list is tested in
 * parts of TIP_PIECE entries. */
static inline int64_t peridynamic_particle_list_chunk_end_index(const struct particles *p, int64_t chunk_start)
{
    return chunk_start + TIP_PIECE < p->n_of[KIND_PD] ? chunk_start + TIP_PIECE : p->n_of[KIND_PD];
}

/* Returns true if the particle numbers particle_number[0] .. particle_number[count - 1] are consecutive integers. They
 * must be strictly ascending, and `count` at least 1. Flags of consecutive particles are tested eight at a time. */
static inline bool particles_have_consecutive_numbers(const int32_t *particle_number, int64_t count)
{
    return particle_number[count - 1] - particle_number[0] == count - 1;
}

/* Extent of a crack from its start. farthest: largest distance of its particles from its start [m]; place: position of
 * its tip, the middle of the farthest particles (of the group with the largest x, if they form several) [m]; ends:
 * number of separate groups of farthest particles; particles: number of particles of the crack. */
struct crack_extent {
    real farthest, place[DIM_MAX];
    int64_t ends, particles;
};

/* Computes the extent of the crack of every tip of t from those particles of p that belong to the crack: the largest
 * distance of a particle from the start of the crack, the number of groups of particles that are at most one spacing
 * nearer (branches), and the middle of the group with the largest x. extent: receives an element for each of TIPS_MAX
 * tips; must be 0 on entry. */
void tips_compute_crack_extents(const struct crack_tips *t, const struct particles *p, struct crack_extent *extent);

/* Search for particles near a position, with a result array that is reused. p: particles; c: search cells over their
 * reference positions; room: capacity of `found`, which the caller releases with memory_free. */
struct tip_search {
    const struct particles *p;
    const struct cells *c;
    int32_t *found; /* result of the last search, particles and mirror images */
    int room;
};

/* Finds the particles, mirror images (copies beyond planes of symmetry) included, whose reference positions are within
 * `radius` [m] of the position `position` [m]. The indices are written to s->found, which grows as needed and which the
 * caller frees after the last search. Returns the number of particles found. */
int tip_search_find_particles_near_position(struct tip_search *s, const real *position, real radius);

/* Computes the vector `offset` from the nearest point of a segment to the point `point`. centre: middle of the segment;
 * half_vector: vector from the middle to one end; all vectors have dim components [m]. Returns the length of `offset`
 * [m], the distance. */
real segment_distance_and_offset_to_point(const real *centre, const real *half_vector, const real *point, int dim,
                                          real *offset);

/* Adds a crack tip without growth to t, which must have fewer than TIPS_MAX. body_number: number of the body;
 * start_position: start position [m]; direction: unit vector of the direction of the crack, NULL for the x axis.
 * Returns the new tip, an element of t->tip. */
struct crack_tip *crack_tips_append_tip_without_growth(struct crack_tips *t, int body_number,
                                                       const real *start_position, const real *direction);

#endif

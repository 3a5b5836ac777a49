/* The frames of a run as a page shows them: selected frames, particle sets that frames share, fields and their ranges.
 * A page has a budget of bytes; film_fit_to_budget keeps it. */
#ifndef CLEAVE_REPORT_FILM
#define CLEAVE_REPORT_FILM

#include "page.h"
#include "plot/plot.h"

enum { FILM_FIELDS_MOST = 24, FILM_LEVELS = 3 };

/* A field of the frames as the page stores it, with 8 bits per particle (fragments: 16). */
struct film_field {
    const struct plot_field *of;
    bool extra;         /* left out first where the budget is short */
    bool fixed;         /* the same in all frames: stored with the particle set */
    bool used;          /* the field differs between particles or frames */
    double least, most; /* smallest and largest value */
    double low, high;   /* values at the ends of the stored range */
    float *sample;      /* [samples] values, for the quantiles */
    int64_t samples;
};

/* Particles that consecutive frames share. A group is a particle, or a cubic cell of particles that is shown
 * as one. */
struct film_set {
    int64_t n;
    float *X[DIM_MAX];        /* [n] reference positions [m] */
    float *size;              /* [n] spacing [m]; NULL: that of the film */
    uint8_t *material, *body; /* [n] */
    bool *busy;               /* [n] damaged or yielded in some frame */
    uint32_t *history;        /* [n] hash of kind and fragment in all frames */
    uint8_t *level;           /* [n] the cell of a merged particle has 2^level particles along an edge; 0: none */
    int64_t groups, shown;    /* number of groups; of them shown */
    int32_t *first, *member;  /* members of group g: member[first[g]] .. member[first[g + 1] - 1] */
    bool *hidden;             /* [groups] */
};

/* A frame of a run that a page shows. */
struct film_frame {
    struct listed_frame listed;
    int64_t step;
    int set; /* index of its particle set */
    bool used;
};

/* The frames of a run as a page shows them: selected frames, particle sets that frames share, and fields. */
struct film {
    const char *folder;
    const struct scene *scene; /* of the run, for its rigid bodies; NULL: not known */
    int dim;
    double spacing; /* smallest distance of particles [m] */
    int listed;     /* number of frames of the run */
    struct film_frame *frame;
    int frames, used; /* frames that were read; of them shown */
    struct film_set *set;
    int sets;
    struct film_field field[FILM_FIELDS_MOST];
    int fields;
    double reach[DIM_MAX]; /* largest displacement along each axis [m] */
    int levels;            /* largest level of merged cells */
    int every;             /* of groups that are not busy only every so manieth is shown */
    bool thins_busy;       /* busy groups are thinned, too */
    bool lacks_extra;      /* extra fields are left out */
};

/* Reads the frames of the run in `folder`, at most about sixty of them, and determines particle sets, displacements
 * and ranges of fields. scene: of the run; NULL: not known. Returns FAILED if a frame cannot be read. Release with
 * film_free; `scene` must exist until then. */
status film_read(struct film *f, const char *folder, const struct scene *scene);

/* Selects the frames, fields and groups of particles that are shown, so that the film needs at most `budget` bytes on
 * the page. */
void film_fit_to_budget(struct film *f, int64_t budget);

/* Writes the selected frames and fields of f to the page p as the entry `film` of its JSON. Returns FAILED if a frame
 * cannot be read again. */
status film_write(struct page *p, const struct film *f);

/* Releases the memory of *f. */
void film_free(struct film *f);

/* Divides the particles of a set into groups (film_groups.c): cells of up to 2^f->levels particles along an edge that
 * are not busy, and have the same kind and fragment in every frame, become one group. */
void film_set_form_groups(struct film_set *s, const struct film *f);

/* Returns the edge of group number `group` of s, the spacing of a particle or the edge of a merged cell of particles
 * [m]. */
double film_group_size(const struct film_set *s, const struct film *f, int64_t group);

/* Fills the table of fields that a run of this dimension may have (film_fields.c). */
void film_fields_list(struct film *f);

/* Updates ranges and samples of all fields from the frame `frame`, read from the file `path`. */
void film_fields_scan(struct film *f, const struct output_frame *frame, const char *path);

/* Chooses for each field the range of values that its 8 or 16 bits represent, and drops fields with the same value in
 * all frames at all particles. */
void film_fields_choose_ranges(struct film *f);

/* Returns the number of bytes of all stored fields that change, for one group in one frame. */
int film_fields_bytes(const struct film *f);

/* Returns true if the field is written to the page: it differs between particles or frames, and is not left out because
 * of the budget. */
bool film_field_is_shown(const struct film *f, const struct film_field *field);

/* Writes the values of one field, means over the groups of s, as an array. frame: read from the file `path`. */
void film_field_write(struct page *p, const struct film_field *field, const struct film_set *s,
                      const struct output_frame *frame, const char *path);

/* Writes the surfaces of the rigid bodies of f->scene to the page as the entry `rigid`, in the plane and in space
 * (film_rigid.c). */
void film_rigids_write(struct page *p, const struct film *f);

/* Writes where the rigid bodies are in frame `number` as the entry `rigid` of that frame: for each body its position
 * [dim, m] and the rows of its rotation [dim][dim]. Writes nothing for a frame without a file of rigid bodies. */
void film_rigids_write_frame(struct page *p, const struct film *f, int number);

#endif

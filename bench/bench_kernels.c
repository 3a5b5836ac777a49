/* floor 5: `cleave bench kernels`: every kernel instance beside the machine's own limits, in one thread. Probes and
 * kernels take turns; the fastest repetition counts. */
#include <ctype.h>
#include <math.h>
#include <string.h>

#include "bench.h"
#include "gnuplot.h"
#include "memory.h"
#include "variants.h"

enum job_kind {
    BOND_FORCE,
    BOND_ENERGY,
    BOND_STRESS,
    PD_MOVE,
    P2G,
    REMAP,
    G2P,
    SPREAD,
    GRID_CLEAR,
    GRID_MOVE,
    GRID_REMAPPED,
    MESH_CLEAR,
    MESH_FORCE,
    MESH_MOVE,
    JOB_KINDS
};

static const char *const job_name[JOB_KINDS] = {"bond_force", "bond_energy", "bond_stress",  "pd_move",
                                                "p2g",        "remap",       "g2p",          "spread",
                                                "grid_clear", "grid_move",   "grid_remapped",
                                                "mesh_clear", "mesh_force",  "mesh_move"};

/* One instance to be timed. */
struct job {
    enum job_kind kind;
    int dim;
    enum pd_model model;
    enum shape shape;
    enum transfer transfer;
    bool finite;         /* strain of a mesh                         */
    const char *variant;
    double seconds;      /* of the fastest call                     */
    double bytes, limit; /* moved a particle; least time it would take a particle [s] */
};

#define BOND_JOBS(D, M)                                                                                                \
    {BOND_FORCE, D, .model = PD_##M, .variant = #M}, {BOND_ENERGY, D, .model = PD_##M, .variant = #M},                 \
        {BOND_STRESS, D, .model = PD_##M, .variant = #M},
#define DIM_JOBS(D)                                                                                                    \
    {PD_MOVE, D, .variant = "-"}, {GRID_CLEAR, D, .variant = "-"}, {GRID_MOVE, D, .variant = "-"},                     \
        {GRID_REMAPPED, D, .variant = "-"}, {MESH_CLEAR, D, .variant = "-"}, {MESH_MOVE, D, .variant = "-"},               \
        {MESH_FORCE, D, .variant = "SMALL"}, {MESH_FORCE, D, .variant = "FINITE", .finite = true},
#define SHAPE_JOBS(D, S)                                                                                               \
    {REMAP, D, .shape = SHAPE_##S, .variant = #S " FLIP"}, {SPREAD, D, .shape = SHAPE_##S, .variant = #S},
#define TRANSFER_JOB(D, S, T)                                                                                          \
    {P2G, D, .shape = SHAPE_##S, .transfer = TRANSFER_##T, .variant = #S " " #T},                                      \
        {G2P, D, .shape = SHAPE_##S, .transfer = TRANSFER_##T, .variant = #S " " #T},
#define TRANSFER_JOBS(D, S) TRANSFER_VARIANTS(TRANSFER_JOB, D, S)

static const struct job all_jobs[] = {PD_VARIANTS(BOND_JOBS) STATE_VARIANTS(BOND_JOBS) DIM_VARIANTS(DIM_JOBS) SHAPE_VARIANTS(SHAPE_JOBS)
                                          SHAPE_VARIANTS(TRANSFER_JOBS)};
enum { JOBS = COUNT_OF(all_jobs) };

/* What is timed on, for each dimension; state-based particles not in 1D. */
enum { BONDS, POINTS, STATES, MESH, YIELDING, GROUNDS };
struct ground {
    struct scene scene[GROUNDS];
    struct engine engine[GROUNDS];
    int32_t *list;
    real *value, *field; /* of spread */
};

struct limits {
    double stencil[DIM_MAX + 1], triad, points;
}; /* [s/bond], [B/s], [s/point] */

struct bench {
    struct ground ground[DIM_MAX + 1];
    struct job job[JOBS];
    struct limits limits;
    struct floor floor;
};

/* ---- ground -------------------------------------------------------------------------------------------- */

/* About 80,000 particles at 0.5 mm; nothing ever breaks. */
static status body_make(struct engine *e, struct scene *s, int dim, const char *method, const char *model, const char *mpm,
                        bool yields)
{
    static const char *const space[DIM_MAX + 1] = {NULL, "line\nsection: 1 mm^2", "plane stress\nthickness: 10 mm",
                                                   "solid"};
    static const char *const size[DIM_MAX + 1] = {NULL, "[40 m]", "[100 mm, 200 mm]", "[20 mm, 20 mm, 25 mm]"};
    static const char *const poisson[DIM_MAX + 1] = {NULL, "", "poisson: 1/3, ", "poisson: 1/4, "};
    static const char *const corner[DIM_MAX + 1] = {NULL, "[0]", "[0, 0]", "[0, 0, 0]"};
    char text[1024];
    snprintf(
        text, sizeof text,
        "name: bench\nspace: %s\nduration: 1 us\nmethod: %s\nmodel: %s\nmaterial: {name: steel, young: 190 GPa, %sdensity: 7800%s}\n"
        "body:\n  - box: {from: %s, to: %s}\nparticles: {spacing: 0.5 mm, horizon: 3.015}\n"
        "mpm: {%s}\noutput: {samples: 1, frames: 0}\ntime: {rest: false}\n",
        space[dim], method, model, poisson[dim],
        yields ? ", yield_stress: 1 GPa" : "", corner[dim], size[dim], mpm);
    TRY(bench_engine_make(e, s, "bench", text, NULL, 0));
    for (int d = 0; d < dim; d++)
        for (int64_t i = 0; i < e->part.n; i++) {
            e->part.v[d][i] = 1e-3 * sin((real)i);
            e->part.x[d][i] += 1e-8 * sin((real)(i + d));
        }
    return bench_engine_run(e, 1, NULL); /* sorts the points and covers them with a grid */
}

static status ground_make(struct ground *g, int dim)
{
    static const char points_of[] = "shape: cpgimp, transfer: apic", mesh[] = "frame: reference";
    TRY(body_make(&g->engine[BONDS], &g->scene[BONDS], dim, "pd", "bond", points_of, false));
    TRY(body_make(&g->engine[YIELDING], &g->scene[YIELDING], dim, "pd", "bond", points_of, true));
    TRY(body_make(&g->engine[POINTS], &g->scene[POINTS], dim, "mpm", "bond", points_of, false));
    if (dim > 1) TRY(body_make(&g->engine[STATES], &g->scene[STATES], dim, "pd", "mospd", points_of, false));
    TRY(body_make(&g->engine[MESH], &g->scene[MESH], dim, "mpm", "bond", mesh, false));
    struct engine *points = &g->engine[POINTS];
    points->transfer.dt = points->transfer.dt_velocity = 1e-12; /* repeated calls leave the state as it is */
    g->list = NEW("bench.list", points->part.n, int32_t);
    g->value = NEW("bench.value", points->part.n, real);
    g->field = NEW("bench.field", points->grid.n, real);
    for (int64_t i = 0; i < points->part.n; i++) g->list[i] = (int32_t)i, g->value[i] = 1;
    return OK;
}

static void ground_free(struct ground *g)
{
    for (int k = 0; k < GROUNDS; k++) bench_engine_free(&g->engine[k], &g->scene[k]);
    memory_free(g->list);
    memory_free(g->value);
    memory_free(g->field);
}

/* ---- timing -------------------------------------------------------------------------------------------- */

static struct engine *bonds_of(const struct job *j, struct ground *g)
{
    return &g->engine[j->model >= PD_OSPD ? STATES : j->model == PD_BOND_PLASTIC ? YIELDING : BONDS];
}

static void job_call(const struct job *j, struct ground *g)
{
    struct engine *pd = bonds_of(j, g), *e = &g->engine[POINTS], *m = &g->engine[MESH];
    struct kernels k;
    kernels_choose(&k, j->dim, j->model, j->shape, j->transfer);
    real impulse[DIM_MAX] = {0}, work = 0;
    switch (j->kind) {
    case BOND_FORCE:
        k.bond_force(&pd->bonds, &pd->part, &pd->source.limit);
        break;
    case BOND_ENERGY:
        k.bond_energy(&pd->bonds, &pd->part);
        break;
    case BOND_STRESS:
        k.bond_stress(&pd->bonds, &pd->part);
        break;
    case PD_MOVE:
        pd_move_table[j->dim](&pd->part, &pd->bonds, 1e-12, 1e-12);
        break;
    case P2G:
        p2g_table[j->dim][j->shape][j->transfer](&e->grid, &e->part, &e->transfer);
        break;
    case REMAP:
        remap_table[j->dim][j->shape](&e->grid, &e->part, &e->transfer);
        break;
    case G2P:
        g2p_table[j->dim][j->shape][j->transfer](&e->grid, &e->part, &e->transfer);
        break;
    case SPREAD:
        spread_table[j->dim][j->shape](&e->grid, &e->part, e->transfer.half_width, g->list, e->part.n, g->value,
                                       g->field);
        break;
    case GRID_CLEAR:
        grid_clear(&e->grid);
        break;
    case GRID_MOVE:
        grid_move(&e->grid, TRANSFER_FLIP, 1e-12, e->smallest_mass, impulse, &work);
        break;
    case MESH_CLEAR:
        mesh_clear(&m->mesh);
        break;
    case MESH_FORCE:
        mesh_force(&m->mesh, m->cell_elastic, j->finite);
        break;
    case MESH_MOVE:
        mesh_move(&m->mesh, 1e-12, 1e-12, impulse, &work);
        break;
    default:
        grid_remapped(&e->grid, e->smallest_mass);
    }
}

/* The first call of the two warms the caches. */
static void job_time(struct job *j, struct ground *g)
{
    for (int k = 0; k < 2; k++) {
        double start = team_clock();
        job_call(j, g);
        j->seconds = fmin(j->seconds, team_clock() - start);
    }
}

static void time_all(struct bench *b, int repetitions)
{
    struct stencil_probe *stencil[DIM_MAX + 1];
    struct triad_probe *triad = triad_probe_make();
    struct point_probe *points = point_probe_make();
    b->limits = (struct limits){.stencil = {INFINITY, INFINITY, INFINITY, INFINITY}, .points = INFINITY};
    for (int d = 1; d <= DIM_MAX; d++) stencil[d] = stencil_probe_make(d);
    for (int r = 0; r < repetitions; r++) {
        for (int k = 0; k < 3; k++) {
            for (int d = 1; d <= DIM_MAX; d++)
                b->limits.stencil[d] = fmin(b->limits.stencil[d], stencil_probe_run(stencil[d]));
            b->limits.points = fmin(b->limits.points, point_probe_run(points));
        }
        b->limits.triad = fmax(b->limits.triad, triad_probe_run(triad));
        for (int k = 0; k < JOBS; k++) job_time(&b->job[k], &b->ground[b->job[k].dim]);
        for (int d = 1; d <= DIM_MAX; d++) grid_clear(&b->ground[d].engine[POINTS].grid);
    }
    for (int d = 1; d <= DIM_MAX; d++) stencil_probe_free(stencil[d]);
    triad_probe_free(triad);
    point_probe_free(points);
}

/* ---- bytes --------------------------------------------------------------------------------------------- */

/* Bytes of a slot as the kernels read it (bond_slot.h), in the mean; patterns stay in cache. */
static double slot_bytes(const struct bonds *b)
{
    double sum = 0;
    for (int64_t g = 0; g < b->groups; g++)
        for (int64_t slot = b->slot[g]; slot < b->slot[g + 1] && !b->pattern[g]; slot++) {
            const struct bond_slot *c = &b->common[slot];
            sum += sizeof *c + (c->alike ? 0 : LANES * sizeof *b->w);
            if (!c->lattice) sum += LANES * (sizeof *b->inverse_length + (c->first < 0 ? sizeof *b->nbr : 0));
        }
    return sum / (double)b->slots;
}

/* Bytes that a kernel must move a particle, counted from the arrays it reads and writes once; nodes shared among the
 * points of their cell. */
static double job_bytes(const struct job *j, struct ground *g)
{
    const double mesh_node = sizeof(real) / (double)(1 << j->dim);
    const struct engine *e = &g->engine[POINTS], *pd = bonds_of(j, g);
    const double r = sizeof(real), dim = j->dim, symmetric = symmetric_count(j->dim);
    const double node = r * (double)e->grid.n / (double)e->part.n, stretch = j->shape == SHAPE_CPGIMP ? dim : 0;
    /* state-based: two sweeps; yielding: two numbers read and written, and the pair of materials */
    const double slots = (double)pd->bonds.slots / (double)pd->part.n;
    const double bond = slots * (slot_bytes(&pd->bonds) * (j->model >= PD_OSPD && j->kind == BOND_FORCE ? 2 : 1) +
                                 (j->model == PD_BOND_PLASTIC ? 36 * LANES : 0)),
                 apic = j->transfer == TRANSFER_APIC;
    switch (j->kind) {
    case BOND_FORCE:
        return bond + 4 + r * (2 * dim + 1); /* x; f; trigger */
    case BOND_ENERGY:
        return bond + 4 + r * dim;
    case BOND_STRESS:
        return bond + 4 + r * (dim + 1 + symmetric); /* x, volume; stress */
    case PD_MOVE:
        return r * (5 * dim + 1); /* x v f mass; x v */
    case P2G:
        return 4 + r * (3 * dim + 2 + symmetric + stretch + apic * dim * dim) + node * 2 * (1 + 2 * dim);
    case REMAP:
        return 4 + r * (3 * dim + 1 + stretch) + node * 3 * dim;
    case G2P:
        return 6 + r * (2 * dim + 2 + 2 * symmetric + 2 * stretch + apic * (dim + dim * dim)) +
               node * dim * (apic ? 1 : 2);
    case SPREAD:
        return 4 + r * (dim + 1 + stretch) + node * 2;
    case GRID_CLEAR:
        return node * (1 + 2 * dim);
    case GRID_MOVE:
        return node * (1 + 5 * dim);
    case MESH_CLEAR:
        return mesh_node * dim;
    case MESH_FORCE:
        return mesh_node * 3 * dim; /* u; f read and written */
    case MESH_MOVE:
        return mesh_node * (1 + 5 * dim);
    default:
        return node * (1 + 2 * dim);
    }
}

static bool on_bonds(const struct job *j) { return j->kind <= BOND_STRESS; }
static int64_t job_particles(const struct job *j, const struct ground *g)
{
    return g->engine[j->kind >= MESH_CLEAR ? MESH : j->kind > PD_MOVE ? POINTS : BONDS].part.n;
}

/* Bonds of a particle; NAN where a kernel visits none. */
static double job_bonds(const struct job *j, const struct ground *g)
{
    return on_bonds(j) ? (double)g->engine[BONDS].bonds.n / (double)g->engine[BONDS].part.n : NAN;
}

/* The larger of what memory and arithmetic need. */
static void find_limits(struct bench *b)
{
    for (int k = 0; k < JOBS; k++) {
        struct job *j = &b->job[k];
        struct ground *g = &b->ground[j->dim];
        j->bytes = job_bytes(j, g);
        j->limit = j->bytes / b->limits.triad;
        if (on_bonds(j)) j->limit = fmax(j->limit, job_bonds(j, g) * b->limits.stencil[j->dim]);
    }
}

/* ---- what is said -------------------------------------------------------------------------------------- */

static void print_limits(const struct limits *l)
{
    printf("  limits of this machine, one thread\n");
    for (int d = 1; d <= DIM_MAX; d++)
        printf("    lattice stencil of the bond law, %dD      %8.3f ns per directed bond\n", d, 1e9 * l->stencil[d]);
    printf("    STREAM triad                             %8.1f GB/s\n", 1e-9 * l->triad);
    printf("    plain cell-sorted MPM, 2D linear FLIP    %8.1f ns per particle and step\n\n", 1e9 * l->points);
}

static void print_jobs(const struct bench *b)
{
    printf("  kernel         dim variant          ns/particle  ns/bond  bytes/particle   GB/s  share of the limit\n");
    for (int k = 0; k < JOBS; k++) {
        const struct job *j = &b->job[k];
        const struct ground *g = &b->ground[j->dim];
        const double each = j->seconds / (double)job_particles(j, g);
        char bond[16] = "";
        if (on_bonds(j)) snprintf(bond, sizeof bond, "%.3f", 1e9 * each / job_bonds(j, g));
        printf("  %-14s  %d  %-16s %10.2f %9s %13.0f %8.1f %10.2f\n", job_name[j->kind], j->dim, j->variant, 1e9 * each,
               bond, j->bytes, 1e-9 * j->bytes / each, j->limit / each);
    }
    printf("  limit: the longer of bytes at the triad's rate and, for bonds, the stencil; above 1 the data stayed in "
           "cache\n\n");
}

static void fill_tables(const struct bench *b, struct bench_table *rows, struct bench_table *limits)
{
    bench_table_make(rows, "",
                     "kernel,dim,variant,particles,seconds_per_particle,seconds_per_bond,bytes_per_particle,limit_"
                     "seconds_per_particle,share_of_limit");
    for (int k = 0; k < JOBS; k++) {
        const struct job *j = &b->job[k];
        const struct ground *g = &b->ground[j->dim];
        const double n = (double)job_particles(j, g), each = j->seconds / n;
        bench_text(rows, job_name[j->kind]);
        bench_number(rows, j->dim);
        bench_text(rows, j->variant);
        const double number[] = {n, each, each / job_bonds(j, g), j->bytes, j->limit, j->limit / each};
        for (size_t c = 0; c < COUNT_OF(number); c++) bench_number(rows, number[c]);
    }
    bench_table_make(limits, "limits",
                     "stencil_1d_seconds_per_bond,stencil_2d_seconds_per_bond,stencil_3d_seconds_per_bond,triad_bytes_"
                     "per_second,points_seconds_per_particle");
    for (int d = 1; d <= DIM_MAX; d++) bench_number(limits, b->limits.stencil[d]);
    bench_number(limits, b->limits.triad);
    bench_number(limits, b->limits.points);
}

static status write_tables(const struct bench *b)
{
    struct bench_table table[4];
    fill_tables(b, &table[0], &table[1]);
    bench_floor_table(&b->floor, &table[2]);
    table[3] = b->floor.laps;
    status s = bench_write("kernels", table, b->floor.laps.cells ? 4 : 3);
    for (int k = 0; k < 3; k++) bench_table_free(&table[k]);
    return s;
}

/* ---- picture ------------------------------------------------------------------------------------------- */

/* The first word in small letters, quoted. */
static void put_shape(FILE *to, const char *variant)
{
    fputc('"', to);
    for (; *variant && *variant != ' '; variant++) fputc(tolower(*variant), to);
    fputc('"', to);
}

/* Blocks $bD (bond kernels, per bond) and $pD (transfers, one row a shape), in ns. */
static void send_data(FILE *to, const struct bench *b)
{
    for (int d = 1; d <= DIM_MAX; d++) {
        fprintf(to, "$b%d << EOD\n", d);
        for (int k = 0; k < JOBS; k++) {
            const struct job *j = &b->job[k];
            if (j->dim != d || !on_bonds(j)) continue;
            const double bonds = job_bonds(j, &b->ground[d]) * (double)job_particles(j, &b->ground[d]);
            fprintf(to, "\"%s\" %.6g\n", job_name[j->kind] + 5, 1e9 * j->seconds / bonds);
        }
        fprintf(to, "EOD\n$p%d << EOD\n", d);
        for (int shape = 0; shape < SHAPES; shape++) {
            for (int k = 0; k < JOBS; k++) {
                const struct job *j = &b->job[k];
                if (j->dim != d || (int)j->shape != shape || (j->kind != P2G && j->kind != G2P && j->kind != REMAP))
                    continue;
                if (j->kind == REMAP) put_shape(to, j->variant);
                fprintf(to, " %.6g", 1e9 * j->seconds / (double)job_particles(j, &b->ground[d]));
            }
            fputc('\n', to);
        }
        fputs("EOD\n", to);
    }
}

static void set_panel(FILE *to, double left, double right, double below, double above)
{
    fprintf(to,
            "set lmargin at screen %g\nset rmargin at screen %g\nset bmargin at screen %g\nset tmargin at screen %g\n",
            left, right, below, above);
}

/* Asked figures as shares of what is asked. */
static void draw_floor(FILE *to, const struct floor *f)
{
    if (!f->figures) return;
    const double most = 4; /* longer bars are cut; their figure tells */
    fputs("$floor << EOD\n", to);
    for (int k = 0; k < f->figures; k++) {
        const struct floor_figure *a = &f->figure[k];
        const double ratio = a->measured / a->limit;
        const double shown = a->at_least ? a->asked / ratio : ratio / a->asked;
        fprintf(to, "\"%s\" %.4g %d %.3g\n", a->name, fmin(shown, most), f->figures - k, shown);
    }
    fputs("EOD\n", to);
    set_panel(to, 0.30, 0.97, 0.05, 0.26);
    fprintf(to,
            "set title 'speed floor: measured over asked (1 or less is met)'\nset xrange [0:%g]\nset yrange "
            "[0.4:%d.6]\nset xtics auto norotate\nset grid noy\n"
            "set arrow 1 from 1, graph 0 to 1, graph 1 nohead dt (6,4) lw 1.4 lc rgb '#3d3d3d'\nset ylabel ''\n"
            "plot $floor using (0.5*$2):3:(0.5*$2):(0.36):ytic(1) with boxxy fs solid 0.85 lc rgb '%s' notitle, "
            "'' using (%g):3:(sprintf('%%.2f', $4)) with labels right notitle\n",
            1.12 * most, f->figures, curve_colour[0], 1.11 * most);
}

static void draw(FILE *to, const void *context)
{
    static const char *const transfer[] = {"re-map", "p2g FLIP", "g2p FLIP", "p2g APIC", "g2p APIC"};
    const struct bench *b = context;
    send_data(to, b);
    fputs("set multiplot\nset style data histograms\nset style histogram clustered gap 1\nset style fill solid 0.85\n"
          "set boxwidth 0.9\nset xtics nomirror scale 0\nset yrange [0:*]\nset offsets 0, 0, graph 0.1, 0\n",
          to);
    for (int d = 1; d <= DIM_MAX; d++) {
        const double left = 0.07 + 0.315 * (d - 1);
        set_panel(to, left, left + 0.27, 0.74, 0.94);
        fprintf(to,
                "set title '%dD: ns per bond'\nset arrow 1 from graph 0, first %.6g to graph 1, first %.6g nohead dt "
                "(6,4) lw 1.4 lc rgb '%s'\n"
                "set key inside left top\nplot $b%d using 2:xtic(1) lc rgb '%s' notitle, NaN with lines dt (6,4) lw "
                "1.4 lc rgb '%s' title '%s'\n",
                d, 1e9 * b->limits.stencil[d], 1e9 * b->limits.stencil[d], curve_colour[1], d, curve_colour[0],
                curve_colour[1], d == 1 ? "stencil limit" : "");
        fprintf(to, "unset arrow 1\nset xtics rotate by -25\n%s\n",
                d == 1 ? "set key at screen 0.5,0.695 center top vertical maxrows 2" : "unset key");
        set_panel(to, left, left + 0.27, 0.40, 0.60);
        fprintf(to, "set title '%dD: ns per particle'\nplot ", d);
        for (int k = 0; k < 5; k++)
            fprintf(to, "%s$p%d using %d:xtic(1) lc rgb '%s' title '%s'", k ? ", " : "", d, k + 2, curve_colour[k],
                    d == 1 ? transfer[k] : "");
        fputs("\nset xtics norotate\n", to);
    }
    draw_floor(to, &b->floor);
    fputs("unset multiplot\n", to);
}

/* ---- all ----------------------------------------------------------------------------------------------- */

static status run(struct bench *b, bool quick)
{
    TRY(bench_floor_memory(&b->floor));
    team_make(1);
    bench_print_machine(1);
    for (int d = 1; d <= DIM_MAX; d++) TRY(ground_make(&b->ground[d], d));
    time_all(b, quick ? 2 : 12);
    find_limits(b);
    print_limits(&b->limits);
    print_jobs(b);
    TRY(bench_floor_speed(&b->floor, quick));
    bench_floor_print(&b->floor);
    TRY(write_tables(b));
    return bench_draw("kernels", 1200, 1100, draw, b);
}

status bench_kernels(bool quick)
{
    struct bench *b = NEW("bench", 1, struct bench);
    memcpy(b->job, all_jobs, sizeof all_jobs);
    for (int k = 0; k < JOBS; k++) b->job[k].seconds = INFINITY;
    printf("kernels\n");
    status s = run(b, quick);
    for (int d = 1; d <= DIM_MAX; d++) ground_free(&b->ground[d]);
    bench_table_free(&b->floor.laps);
    memory_free(b);
    return s;
}

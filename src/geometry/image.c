/* Reads image files into voxels. */
#include "geometry/image.h"

#include "base/memory.h"
#include "base/team.h"
#include "pages.h"

enum { SHRINKS_MOST = 1100, BITS = 8 }; /* largest compression (deflate reaches 1032); pixels per byte at 1 bit */
enum { BYTES_A_VOXEL = 16 };            /* memory for grey values and levels per voxel while they are made */

int luminance(int red, int green, int blue) { return (int)(0.2126 * red + 0.7152 * green + 0.0722 * blue + 0.5); }

status image_pages_append_page(struct image_pages *p, const struct geometry_file *file, int64_t width, int64_t height,
                               uint16_t **grey_values)
{
    const int64_t memory = machine_memory_size();
    const real all = (real)width * (real)height * (real)(p->n + 1);
    if (width < 1 || height < 1)
        return status_set(REFUSED, "%s: the image has no pixels; give another image", file->path);
    if (p->n > 0 && (width != p->width || height != p->height))
        return status_set(
            REFUSED,
            "%s: this slice has %lld x %lld pixels, but earlier slices have %lld x %lld; give slices of equal size",
            file->path, (long long)width, (long long)height, (long long)p->width, (long long)p->height);
    if ((real)width * (real)height > (real)file->length * SHRINKS_MOST * BITS)
        return status_set(REFUSED,
                          "%s: its header gives %lld x %lld pixels, more than a file of its size can contain, so it is "
                          "damaged; save it again",
                          file->path, (long long)width, (long long)height);
    if (all > VOXELS_MAX || (memory > 0 && all * BYTES_A_VOXEL > (real)memory))
        return status_set(REFUSED, "%s: %.3g voxels do not fit into memory; use fewer or smaller slices", file->path,
                          all);
    const int64_t size = width * height;
    p->grey = memory_resize("image.grey", p->grey, p->n * size, (p->n + 1) * size, sizeof *p->grey);
    *grey_values = p->grey + p->n * size;
    p->width = width, p->height = height, p->n++;
    return OK;
}

/* Appends all pages of the PNG or TIFF file `path` to p. Returns REFUSED, with a message, if the file is neither or
 * malformed. */
static status file_read(struct image_pages *p, const char *path)
{
    struct geometry_file s;
    TRY(geometry_file_read_whole(&s, path));
    const bool png = s.length > 4 && memcmp(s.text, "\x89PNG", 4) == 0;
    const bool tiff = s.length > 4 && (memcmp(s.text, "II", 2) == 0 || memcmp(s.text, "MM", 2) == 0);
    const status result =
        png    ? png_read_pages(p, &s)
        : tiff ? tiff_read_pages(p, &s)
               : status_set(REFUSED, "%s: the file is neither PNG nor TIFF; save it as one of them", path);
    geometry_file_close(&s);
    return result;
}

/* Appends the pages of the files path[files] to p. dim: dimensions of the space. Returns REFUSED, with a message, for
 * an invalid file, and if there is more than one page in 2D. */
static status files_read(struct image_pages *p, int files, char *const *path, int dim)
{
    for (int k = 0; k < files; k++) TRY(file_read(p, path[k]));
    if (dim == 3 || p->n == 1) return OK;
    return status_set(REFUSED, "%s: the file has %lld images; in plane spaces give a single one", path[0],
                      (long long)p->n);
}

/* Reverses the order of rows in each page of p: the file has the top row first, and y must increase with the row. */
static void rows_flip(struct image_pages *p)
{
    for (int64_t k = 0; k < p->n; k++)
        for (int64_t j = 0; j < p->height / 2; j++) {
            uint16_t *low = p->grey + (k * p->height + j) * p->width;
            uint16_t *high = p->grey + (k * p->height + p->height - 1 - j) * p->width;
            for (int64_t i = 0; i < p->width; i++) {
                const uint16_t grey = low[i];
                low[i] = high[i], high[i] = grey;
            }
        }
}

status image_read_voxels(struct voxels *v, int file_count, char *const *file_paths, int dim, const real *voxel_size,
                         const real *lower_corner)
{
    struct image_pages p = {0};
    const status result = files_read(&p, file_count, file_paths, dim);
    *v = (struct voxels){0};
    if (result != OK) {
        memory_free(p.grey);
        return result;
    }
    rows_flip(&p);
    *v = (struct voxels){.dim = dim, .n = {p.width, p.height, p.n}, .grey = p.grey};
    for (int d = 0; d < dim; d++) v->size[d] = voxel_size[d], v->from[d] = lower_corner[d];
    return OK;
}

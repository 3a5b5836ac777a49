/* Films: PNG pictures of all frames, encoded by ffmpeg. */
#ifndef CLEAVE_FILM
#define CLEAVE_FILM

#include "plot/plot.h"

/* Checks that the program ffmpeg, which encodes films, can be started. Returns REFUSED if not; the message names the
 * package to install. */
status video_check_encoder_is_installed(void);

/* Draws one picture for each of frame_particles[frame_count], the particles in each frame (state at one time) of a run.
 * Encodes the pictures as a film (video) of the format output.format in the file output.path. fps: frames per second, 0
 * for the default of 8; title: heading of each picture; map: quantity that the colours show; view: common rectangle and
 * range of the colours. The pictures are drawn in a temporary folder beside the film, which is removed. Returns FAILED
 * if gnuplot or ffmpeg fails, REFUSED if output.path is a file that must not be replaced. */
status video_draw_and_encode_frames(struct output_picture output, int fps, const char *title, enum map map,
                                    const struct view *view, const struct plotted_particles *frame_particles,
                                    int frame_count);

#endif

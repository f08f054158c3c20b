/* [W, status, report] = repair_mex(V, F, precision): a repair by the C library, for Octave and MATLAB.
 *
 * V: n x 3 positions, F: m x 3 vertex numbers from 1. precision: 'auto' (default), 'float32' or 'float64'.
 * W: n x 3; status: 'embedded' where no self-intersection is left; report: JSON, for jsondecode.
 *
 * Octave: mkoctfile --mex repair_mex.c -lunsnarl_c        MATLAB: mex repair_mex.c -lunsnarl_c */
#include <mex.h>
#include <unsnarl/unsnarl.h>

/* A vertex number, from 0; -1, which the library refuses, where it is none. */
static int32_t vertex_of(double number) {
  if (!(number >= 1 && number <= INT32_MAX) || number != (double)(int32_t)number) return -1;
  return (int32_t)number - 1;
}

void mexFunction(int result_count, mxArray** results, int count, const mxArray** arguments) {
  const double *V, *F;
  double *positions, *W;
  int32_t* corners;
  mwSize n, m, k, c;
  char precision[16] = "auto";
  unsnarl_surface surface = {sizeof surface};
  unsnarl_options options;
  unsnarl_result* repaired;
  unsnarl_array moved;

  if (count < 2 || count > 3 || !mxIsDouble(arguments[0]) || !mxIsDouble(arguments[1]) || mxGetN(arguments[0]) != 3 ||
      mxGetN(arguments[1]) != 3)
    mexErrMsgIdAndTxt("unsnarl:arguments", "repair_mex(V, F, precision): V is n x 3, F is m x 3, both double");
  if (count == 3 && mxGetString(arguments[2], precision, sizeof precision) != 0)
    mexErrMsgIdAndTxt("unsnarl:arguments", "precision is 'auto', 'float32' or 'float64'");
  V = mxGetPr(arguments[0]), n = mxGetM(arguments[0]);
  F = mxGetPr(arguments[1]), m = mxGetM(arguments[1]);

  /* Matrices lie column after column, the library takes one vertex or face after another. mxMalloc's memory is freed
   * where the function ends, also by an error. */
  positions = mxMalloc(3 * n * sizeof *positions + 1);
  corners = mxMalloc(3 * m * sizeof *corners + 1);
  for (c = 0; c < 3; ++c) {
    for (k = 0; k < n; ++k) positions[3 * k + c] = V[c * n + k];
    for (k = 0; k < m; ++k) corners[3 * k + c] = vertex_of(F[c * m + k]);
  }
  surface.positions = positions, surface.vertex_count = n;
  surface.corners = corners, surface.corner_count = 3 * m;
  unsnarl_options_init(&options, sizeof options);
  options.precision = precision;
  if (unsnarl_repair(&surface, &options, NULL, &repaired) != UNSNARL_OK)
    mexErrMsgIdAndTxt("unsnarl:repair", "%s", unsnarl_error_message());

  unsnarl_result_array(repaired, "positions", &moved);
  results[0] = mxCreateDoubleMatrix(n, 3, mxREAL);
  W = mxGetPr(results[0]);
  for (k = 0; k < n; ++k)
    for (c = 0; c < 3; ++c) W[c * n + k] = ((const double*)moved.data)[3 * k + c];
  if (result_count > 1) results[1] = mxCreateString(unsnarl_result_status(repaired));
  if (result_count > 2) results[2] = mxCreateString(unsnarl_result_report(repaired));
  unsnarl_result_free(repaired);
}

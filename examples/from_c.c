/* Repairs a mesh file from C: reads it, shows how far it is, writes it certified. from_c IN OUT */
#include <stdio.h>
#include <string.h>
#include <unsnarl/unsnarl.h>

static int show(const unsnarl_progress* progress, void* data) {
  (void)data;
  fprintf(stderr, "%3.0f %% %s\n", 100 * progress->fraction, progress->phase);
  return 0; /* nonzero: cancel */
}

static int failed(void) {
  fprintf(stderr, "error: %s\n", unsnarl_error_message());
  return 1;
}

int main(int count, char** arguments) {
  unsnarl_document* document;
  unsnarl_result* result;
  unsnarl_surface surface = {sizeof surface};
  unsnarl_options options;
  unsnarl_context* context;
  int embedded;

  if (count != 3) return 2;
  if (unsnarl_document_read(arguments[1], NULL, &document) != UNSNARL_OK) return failed();
  if (unsnarl_document_surface(document, &surface) != UNSNARL_OK) return failed();

  if (unsnarl_options_init(&options, sizeof options) != UNSNARL_OK) return failed();
  options.max_displacement = 0.1; /* of the diagonal of the bounding box */
  context = unsnarl_context_new(show, NULL);
  /* what is written is read back and certified before it is in place */
  if (unsnarl_document_repair(document, &surface, arguments[2], &options, context, &result) != UNSNARL_OK)
    return failed();
  unsnarl_context_free(context);

  embedded = strcmp(unsnarl_result_status(result), "embedded") == 0;
  printf("%s: %s\n", arguments[1], unsnarl_result_status(result));
  unsnarl_result_free(result);
  unsnarl_document_free(document);
  return embedded ? 0 : 1;
}

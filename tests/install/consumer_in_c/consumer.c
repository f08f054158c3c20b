/* A program of somebody else, in C: an empty mesh is embedded. */
#include <stdio.h>
#include <string.h>
#include <unsnarl/unsnarl.h>

int main(void) {
  unsnarl_surface nothing = {sizeof nothing};
  unsnarl_result* result;
  int embedded;
  if (unsnarl_repair(&nothing, NULL, NULL, &result) != UNSNARL_OK) {
    fprintf(stderr, "%s\n", unsnarl_error_message());
    return 1;
  }
  embedded = strcmp(unsnarl_result_status(result), "embedded") == 0;
  unsnarl_result_free(result);
  return embedded ? 0 : 1;
}

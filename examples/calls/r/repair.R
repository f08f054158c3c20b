# A repair in R, by the Python package unsnarl. vertices: n x 3 positions; faces: m x 3 vertex numbers from 1; ...:
# options of unsnarl.repair, as in min_gap = 0.001. Gives positions, the status ("embedded": no self-intersection is
# left) and the report, a list.
repair <- function(vertices, faces, ...) {
  storage.mode(faces) <- "integer"
  result <- reticulate::import("unsnarl")$repair(vertices, faces - 1L, ...)
  list(vertices = result$V, status = as.character(result$status), report = result$report)
}

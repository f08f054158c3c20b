% V: n x 3 positions, F: m x 3 vertex numbers from 1. Repairs them with the program `unsnarl`, through OFF files in a
% temporary folder. options: of `unsnarl fix`, as in '--min-gap 0.001'. status: its exit code (0: no self-intersections
% left); said: its messages. Where the program has written no result, W is V.
% Runs in Octave; it uses no function that MATLAB lacks, but was not run there.
function [W, status, said] = repair_off(V, F, options, program)
  if nargin < 3, options = ''; end
  if nargin < 4, program = 'unsnarl'; end
  folder = tempname(); mkdir(folder);
  in = fullfile(folder, 'in.off'); out = fullfile(folder, 'out.off');
  file = fopen(in, 'w');
  fprintf(file, 'OFF\n%d %d 0\n', size(V, 1), size(F, 1));
  fprintf(file, '%.17g %.17g %.17g\n', V');
  fprintf(file, '3 %d %d %d\n', (F - 1)');
  fclose(file);
  [status, said] = system(sprintf('"%s" fix "%s" -o "%s" --no-partial %s 2>&1', program, in, out, options));
  W = V;
  if exist(out, 'file')
    file = fopen(out, 'r'); fgetl(file); fgetl(file);
    W = fscanf(file, '%f', [3, size(V, 1)])';
    fclose(file); delete(out);
  end
  delete(in); rmdir(folder);
end

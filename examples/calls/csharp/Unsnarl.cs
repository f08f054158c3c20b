// A repair by the C library, libunsnarl_c. Compile with -unsafe.
using System;
using System.Runtime.InteropServices;

public static unsafe class Unsnarl {
  // The first fields of the structs of unsnarl.h; their size says where they end.
  struct Surface {
    public UIntPtr size;
    public double* positions;
    public UIntPtr vertexCount;
    public int* corners;
    public UIntPtr cornerCount;
  }
  struct Options {
    public UIntPtr size;
    public IntPtr weld;
    public double weldTolerance;
    public int bothDiagonals, threads;
    public IntPtr goal, precision;
    public double minGap, maxDisplacement;
    public int absolute;
  }
  struct Array {
    public double* data;
    public UIntPtr rows, columns;
    public int type;
  }
  const string library = "unsnarl_c";
  [DllImport(library)] static extern int unsnarl_options_init(Options* options, UIntPtr size);
  [DllImport(library)]
  static extern int unsnarl_repair(Surface* surface, Options* options, IntPtr context, out IntPtr result);
  [DllImport(library)] static extern int unsnarl_result_array(IntPtr result, string name, Array* array);
  [DllImport(library)] static extern IntPtr unsnarl_result_status(IntPtr result);
  [DllImport(library)] static extern void unsnarl_result_free(IntPtr result);
  [DllImport(library)] static extern IntPtr unsnarl_error_message();

  static void Check(int code) {
    if (code != 0) throw new ArgumentException(Marshal.PtrToStringAnsi(unsnarl_error_message()));
  }

  // positions: x y z of each vertex, which are moved; corners: three vertices a face, from 0; precision: "auto",
  // "float32" or "float64"; minGap: a fraction of the diagonal. Returns the status: "embedded" where no
  // self-intersection is left.
  public static string Repair(double[] positions, int[] corners, string precision = "auto", double minGap = 0) {
    IntPtr result = IntPtr.Zero, name = Marshal.StringToHGlobalAnsi(precision);
    try {
      fixed (double* first = positions) fixed (int* corner = corners) {
        var surface = new Surface {
          size = (UIntPtr)sizeof(Surface),
          positions = first, vertexCount = (UIntPtr)(positions.Length / 3),
          corners = corner, cornerCount = (UIntPtr)corners.Length };
        Options options;
        Check(unsnarl_options_init(&options, (UIntPtr)sizeof(Options)));
        options.precision = name;
        options.minGap = minGap;
        Check(unsnarl_repair(&surface, &options, IntPtr.Zero, out result));
        Array moved;
        Check(unsnarl_result_array(result, "positions", &moved));
        Marshal.Copy((IntPtr)moved.data, positions, 0, positions.Length);
        return Marshal.PtrToStringAnsi(unsnarl_result_status(result));
      }
    } finally {
      unsnarl_result_free(result);
      Marshal.FreeHGlobal(name);
    }
  }
}

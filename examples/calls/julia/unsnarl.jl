# A repair by the C library, libunsnarl_c. Written for Julia 1.6 and later; it was not run.
const libunsnarl = "libunsnarl_c"  # or its full path

# The first fields of the structs of unsnarl.h; their size says where they end.
struct Surface
    size::Csize_t
    positions::Ptr{Float64}
    vertex_count::Csize_t
    corners::Ptr{Int32}
    corner_count::Csize_t
end
mutable struct Options
    size::Csize_t
    weld::Ptr{UInt8}
    weld_tolerance::Float64
    both_diagonals::Int32
    threads::Int32
    goal::Ptr{UInt8}
    precision::Ptr{UInt8}
    min_gap::Float64
    max_displacement::Float64
    absolute::Int32
    Options() = new()
end
struct ResultArray
    data::Ptr{Float64}
    rows::Csize_t
    columns::Csize_t
    type::Cint
end

checked(code) = code == 0 || error(unsafe_string(ccall((:unsnarl_error_message, libunsnarl), Ptr{UInt8}, ())))

"""
V: 3 x n positions, F: 3 x m vertex numbers from 1, precision: "auto", "float32" or "float64". Gives the new positions
and the status: "embedded" where no self-intersection is left.
"""
function repair(V::Matrix{Float64}, F::Matrix{<:Integer}; precision = "auto")
    corners = Int32.(F .- 1)
    options = Options()
    checked(ccall((:unsnarl_options_init, libunsnarl), Cint, (Ref{Options}, Csize_t), options, sizeof(Options)))
    result = Ref{Ptr{Cvoid}}()
    GC.@preserve V corners precision begin
        options.precision = pointer(precision)
        surface = Ref(Surface(sizeof(Surface), pointer(V), size(V, 2), pointer(corners), length(corners)))
        checked(ccall((:unsnarl_repair, libunsnarl), Cint, (Ref{Surface}, Ref{Options}, Ptr{Cvoid}, Ref{Ptr{Cvoid}}),
                      surface, options, C_NULL, result))
    end
    try
        moved = Ref{ResultArray}()
        checked(ccall((:unsnarl_result_array, libunsnarl), Cint, (Ptr{Cvoid}, Cstring, Ref{ResultArray}),
                      result[], "positions", moved))
        W = copy(unsafe_wrap(Array, moved[].data, size(V)))
        W, unsafe_string(ccall((:unsnarl_result_status, libunsnarl), Ptr{UInt8}, (Ptr{Cvoid},), result[]))
    finally
        ccall((:unsnarl_result_free, libunsnarl), Cvoid, (Ptr{Cvoid},), result[])
    end
end

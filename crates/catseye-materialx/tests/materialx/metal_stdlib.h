// As much of Metal's standard library as generated shaders use, for clang's C++17 and its vectors: declarations, without the
// bodies. Address spaces are not told apart: `constant` is const, the others are nothing.
#define constant const
#define thread
#define device
#define vertex
#define fragment
#define M_PI_F 3.14159265f

typedef unsigned int uint;
#define CATSEYE_VECTORS(T) \
    typedef T T##2 __attribute__((ext_vector_type(2))); \
    typedef T T##3 __attribute__((ext_vector_type(3))); \
    typedef T T##4 __attribute__((ext_vector_type(4)));
CATSEYE_VECTORS(float)
CATSEYE_VECTORS(int)
CATSEYE_VECTORS(bool)

// Metal's float3(...) constructs; to clang it is a cast of the last argument. So it becomes a call, whose arguments must have
// as many components as the vector, or be one number.
template<class T> constexpr int components = 1;
template<class T, int N> constexpr int components<T __attribute__((ext_vector_type(N)))> = N;
template<class V, class... A> V make(A...)
{
    constexpr int given = (components<A> + ...);
    static_assert(given == components<V> || (sizeof...(A) == 1 && given == 1));
    return {};
}
#define float2(...) make<float2>(__VA_ARGS__)
#define float3(...) make<float3>(__VA_ARGS__)
#define float4(...) make<float4>(__VA_ARGS__)
#define int2(...) make<int2>(__VA_ARGS__)
#define int3(...) make<int3>(__VA_ARGS__)

template<int N> struct matrix
{
    typedef float column __attribute__((ext_vector_type(N)));
    column columns[N];
    matrix() = default;
    explicit matrix(float);
    template<class... A> matrix(A...)
    {
        static_assert((components<A> + ...) == N * N);
    }
    column& operator[](int i) { return columns[i]; }
    const column& operator[](int i) const { return columns[i]; }
};
template<int N> matrix<N> operator*(matrix<N>, matrix<N>);
template<int N> matrix<N> operator+(matrix<N>, matrix<N>);
template<int N> matrix<N> operator-(matrix<N>, matrix<N>);
template<int N> typename matrix<N>::column operator*(matrix<N>, typename matrix<N>::column);
template<int N> typename matrix<N>::column operator*(typename matrix<N>::column, matrix<N>);
typedef matrix<2> float2x2;
typedef matrix<3> float3x3;
typedef matrix<4> float4x4;

template<class To, class From> To as_type(From);

namespace metal
{
#define CATSEYE_EACH(T) \
    T sin(T); T cos(T); T tan(T); T asin(T); T acos(T); T atan(T); T atan2(T, T); T exp(T); T exp2(T); T log(T); T log2(T); \
    T pow(T, T); T sqrt(T); T rsqrt(T); T abs(T); T sign(T); T floor(T); T ceil(T); T round(T); T fract(T); T fmod(T, T); \
    T min(T, T); T max(T, T); T clamp(T, T, T); T mix(T, T, T); T step(T, T); T smoothstep(T, T, T); \
    T normalize(T); T reflect(T, T); T refract(T, T, float); T dfdx(T); T dfdy(T); T fwidth(T); \
    float dot(T, T); float length(T); float distance(T, T);
#define CATSEYE_SCALAR(T) T min(T, float); T max(T, float); T clamp(T, float, float); T mix(T, T, float);
CATSEYE_EACH(float) CATSEYE_EACH(float2) CATSEYE_EACH(float3) CATSEYE_EACH(float4)
CATSEYE_SCALAR(float2) CATSEYE_SCALAR(float3) CATSEYE_SCALAR(float4)
int abs(int); int min(int, int); int max(int, int); int clamp(int, int, int);
bool isnan(float); bool isinf(float);
float3 cross(float3, float3);
template<int N> matrix<N> transpose(matrix<N>);
template<int N> float determinant(matrix<N>);
void discard_fragment();

struct sampler {};
struct level { level(float); };
struct gradient2d { gradient2d(float2, float2); };
template<class T> struct texture2d
{
    float4 sample(sampler, float2) const;
    float4 sample(sampler, float2, level) const;
    float4 sample(sampler, float2, gradient2d) const;
    int get_width() const;
    int get_height() const;
    int get_num_mip_levels() const;
};
}

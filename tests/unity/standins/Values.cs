// The Unity value types that the package uses, as far as it uses them.
using System;
using System.Runtime.InteropServices;

namespace UnityEngine
{
    [Serializable, StructLayout(LayoutKind.Sequential)]
    public struct Vector2
    {
        public float x, y;
        public Vector2(float x, float y) { this.x = x; this.y = y; }
    }

    [Serializable, StructLayout(LayoutKind.Sequential)]
    public struct Vector3
    {
        public float x, y, z;
        public Vector3(float x, float y, float z) { this.x = x; this.y = y; this.z = z; }
        public static Vector3 operator +(Vector3 a, Vector3 b) { return new Vector3(a.x + b.x, a.y + b.y, a.z + b.z); }
        public static Vector3 operator -(Vector3 a, Vector3 b) { return new Vector3(a.x - b.x, a.y - b.y, a.z - b.z); }
        public static Vector3 operator *(Vector3 a, float k) { return new Vector3(a.x * k, a.y * k, a.z * k); }
        public static Vector3 Min(Vector3 a, Vector3 b) { return new Vector3(Math.Min(a.x, b.x), Math.Min(a.y, b.y), Math.Min(a.z, b.z)); }
        public static Vector3 Max(Vector3 a, Vector3 b) { return new Vector3(Math.Max(a.x, b.x), Math.Max(a.y, b.y), Math.Max(a.z, b.z)); }
        public static float Dot(Vector3 a, Vector3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
        public float magnitude { get { return (float)Math.Sqrt(Dot(this, this)); } }
        public override string ToString() { return "(" + x + ", " + y + ", " + z + ")"; }
    }

    [Serializable, StructLayout(LayoutKind.Sequential)]
    public struct Vector4
    {
        public float x, y, z, w;
        public Vector4(float x, float y, float z, float w) { this.x = x; this.y = y; this.z = z; this.w = w; }
    }

    [Serializable, StructLayout(LayoutKind.Sequential)]
    public struct Color
    {
        public float r, g, b, a;
        public Color(float r, float g, float b, float a = 1) { this.r = r; this.g = g; this.b = b; this.a = a; }
        public static Color red { get { return new Color(1, 0, 0); } }
        public static Color green { get { return new Color(0, 1, 0); } }
        public static Color gray { get { return new Color(0.5f, 0.5f, 0.5f); } }
        public static Color yellow { get { return new Color(1, 0.92f, 0.016f); } }
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct Color32
    {
        public byte r, g, b, a;
        private static byte Byte(float value) { return (byte)Math.Round(Math.Max(0, Math.Min(1, value)) * 255); }
        public static implicit operator Color32(Color c) { return new Color32 { r = Byte(c.r), g = Byte(c.g), b = Byte(c.b), a = Byte(c.a) }; }
        public static implicit operator Color(Color32 c) { return new Color(c.r / 255f, c.g / 255f, c.b / 255f, c.a / 255f); }
    }

    public struct Hash128
    {
        public string text;
        public override string ToString() { return text; }
        public static Hash128 Compute(string text) { return new Hash128 { text = text }; }
    }

    /// None turns here.
    public struct Quaternion { }

    /// Column by column, as Unity has it.
    [Serializable, StructLayout(LayoutKind.Sequential)]
    public unsafe struct Matrix4x4
    {
        public float m00, m10, m20, m30, m01, m11, m21, m31, m02, m12, m22, m32, m03, m13, m23, m33;
        public static Matrix4x4 identity { get { return new Matrix4x4 { m00 = 1, m11 = 1, m22 = 1, m33 = 1 }; } }
        public static Matrix4x4 zero { get { return new Matrix4x4(); } }

        public float this[int place]
        {
            get { fixed (float* first = &m00) { return first[Checked(place)]; } }
            set { fixed (float* first = &m00) { first[Checked(place)] = value; } }
        }

        private static int Checked(int place)
        {
            if (place < 0 || place > 15) { throw new IndexOutOfRangeException("Invalid matrix index!"); }
            return place;
        }

        public static Matrix4x4 operator *(Matrix4x4 a, Matrix4x4 b)
        {
            var product = new Matrix4x4();
            for (int i = 0; i < 16; i++) { for (int k = 0; k < 4; k++) { product[i] += a[i % 4 + 4 * k] * b[k + i / 4 * 4]; } }
            return product;
        }

        public Vector3 MultiplyPoint3x4(Vector3 p)
        {
            return new Vector3(m00 * p.x + m01 * p.y + m02 * p.z + m03, m10 * p.x + m11 * p.y + m12 * p.z + m13, m20 * p.x + m21 * p.y + m22 * p.z + m23);
        }

        public static Matrix4x4 TRS(Vector3 position, Quaternion rotation, Vector3 scale)
        {
            return new Matrix4x4 { m00 = scale.x, m11 = scale.y, m22 = scale.z, m33 = 1, m03 = position.x, m13 = position.y, m23 = position.z };
        }

        /// Of transforms that are not turned; zeros where there is none.
        public Matrix4x4 inverse
        {
            get
            {
                if (m01 != 0 || m02 != 0 || m10 != 0 || m12 != 0 || m20 != 0 || m21 != 0) { throw new NotSupportedException(); }
                if (m00 * m11 * m22 == 0) { return zero; }
                return TRS(new Vector3(-m03 / m00, -m13 / m11, -m23 / m22), new Quaternion(), new Vector3(1 / m00, 1 / m11, 1 / m22));
            }
        }
    }

    public struct Rect { public bool Contains(Vector2 place) { return true; } }

    public struct Bounds
    {
        public Bounds(Vector3 center, Vector3 size) : this() { min = center - size * 0.5f; max = center + size * 0.5f; }
        public Vector3 min { get; set; }
        public Vector3 max { get; set; }
        public Vector3 size { get { return max - min; } }
        public void Encapsulate(Bounds other) { min = Vector3.Min(min, other.min); max = Vector3.Max(max, other.max); }
    }

    public struct BoneWeight1
    {
        public float weight { get; set; }
        public int boneIndex { get; set; }
    }

    public enum MeshTopology { Triangles = 0, Quads = 2, Lines = 3, LineStrip = 4, Points = 5 }
}

namespace UnityEngine.Rendering
{
    public enum IndexFormat { UInt16, UInt32 }
    public enum CompareFunction { Disabled, Never, Less, Equal, LessEqual, Greater, NotEqual, GreaterEqual, Always }
    public enum VertexAttribute { Position, Normal, Tangent, Color, TexCoord0, TexCoord1, TexCoord2, TexCoord3, TexCoord4, TexCoord5, TexCoord6, TexCoord7, BlendWeight, BlendIndices }
    public enum VertexAttributeFormat { Float32, Float16, UNorm8 }

    public struct SubMeshDescriptor
    {
        public MeshTopology topology { get; set; }
        public int indexCount { get; set; }
    }
}

namespace Unity.Collections
{
    public enum Allocator { Invalid, None, Temp, TempJob, Persistent }

    public struct NativeArray<T> : IDisposable where T : struct
    {
        private readonly T[] values;
        public NativeArray(int length, Allocator allocator) { values = new T[length]; }
        public NativeArray(T[] array, Allocator allocator) { values = (T[])array.Clone(); }
        public int Length { get { return values.Length; } }
        public T this[int index] { get { return values[index]; } set { values[index] = value; } }
        public T[] ToArray() { return (T[])values.Clone(); }
        public void CopyFrom(T[] array) { array.CopyTo(values, 0); }
        public void Dispose() { }
    }
}

namespace AOT
{
    [AttributeUsage(AttributeTargets.Method)]
    public class MonoPInvokeCallbackAttribute : Attribute
    {
        public MonoPInvokeCallbackAttribute(Type type) { }
    }
}

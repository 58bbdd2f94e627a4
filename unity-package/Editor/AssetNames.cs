using System.IO;
using System.Linq;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>Names of files for chamfered meshes.</summary>
    internal static class AssetNames
    {
        /// <summary>What no system allows: a name from one machine has to do on all.</summary>
        private const string Forbidden = "<>:\"/\\|?*";

        /// <summary>
        /// After the file of the source and, where it has another name, the mesh: models have many of the same name.
        /// </summary>
        internal static string Of(Mesh source)
        {
            string mesh = Clean(source.name);
            string path = AssetDatabase.GetAssetPath(source);
            // Unity's own meshes have a file that says nothing.
            string file = IsOfProject(path) || IsOfPackage(path) ? Clean(Path.GetFileNameWithoutExtension(path)) : "";
            if (file.Length == 0 || file == mesh) { return OrMesh(mesh) + JobResult.Suffix; }
            return (mesh.Length == 0 ? file : file + " " + mesh) + JobResult.Suffix;
        }

        /// <summary>A path that nothing has yet.</summary>
        internal static string Free(string folder, Mesh source)
        {
            return AssetDatabase.GenerateUniqueAssetPath(folder + "/" + Of(source) + ".asset");
        }

        /// <summary>Where a file can lie beside a mesh: packages cannot be written to.</summary>
        internal static string FolderBeside(Mesh source)
        {
            string path = AssetDatabase.GetAssetPath(source);
            return IsOfProject(path) ? Folder(path) : "Assets";
        }

        /// <summary>The folder of a file, without a slash at its end.</summary>
        internal static string Folder(string path)
        {
            return path.Substring(0, System.Math.Max(0, path.LastIndexOf('/')));
        }

        private static bool IsOfProject(string path)
        {
            return path.StartsWith("Assets/", System.StringComparison.Ordinal);
        }

        private static bool IsOfPackage(string path)
        {
            return path.StartsWith("Packages/", System.StringComparison.Ordinal);
        }

        private static string OrMesh(string name)
        {
            return name.Length == 0 ? "Mesh" : name;
        }

        private static string Clean(string name)
        {
            var letters = name.Select(letter => letter < ' ' || Forbidden.IndexOf(letter) >= 0 ? '_' : letter);
            return new string(letters.ToArray()).Trim(' ', '.');
        }
    }
}

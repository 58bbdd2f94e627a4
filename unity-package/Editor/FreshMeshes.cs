using System.Collections.Generic;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>
    /// The meshes that were made in the current undo step. While a slider is dragged they are written anew
    /// instead of leaving one behind for every step of the mouse.
    /// </summary>
    internal static class FreshMeshes
    {
        private static readonly HashSet<Mesh> meshes = new HashSet<Mesh>();
        private static int group = -1;

        internal static void Add(Mesh mesh)
        {
            if (group != Undo.GetCurrentGroup()) { meshes.Clear(); }
            group = Undo.GetCurrentGroup();
            meshes.Add(mesh);
        }

        internal static bool Contains(Mesh mesh)
        {
            return group == Undo.GetCurrentGroup() && meshes.Contains(mesh);
        }
    }
}

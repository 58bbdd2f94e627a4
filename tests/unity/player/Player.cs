// Chamfers as a script of a game would, and prints what it is told.
using System;
using UnityEngine;

namespace Chamfer.Tests
{
    internal static class Player
    {
        private static void Main()
        {
            var mesh = new Mesh { name = "Triangle", vertices = new Vector3[3], normals = new Vector3[3] };
            mesh.SetTriangles(new[] { 0, 1, 2 }, 0);
            try { MeshChamfer.Run(mesh, ChamferSettings.Default); }
            catch (ChamferException exception) { Console.WriteLine(exception.GetType().Name + ": " + exception.Message); }
        }
    }
}

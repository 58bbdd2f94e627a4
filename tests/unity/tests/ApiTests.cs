// What scripts and menus of components reach, and the package's own tests for a real editor.
using System;
using System.Linq;
using System.Reflection;
using System.Threading;
using Chamfer;
using ChamferEditor;
using UnityEditor;
using UnityEngine;

namespace Chamfer.Tests
{
    internal static class ApiTests
    {
        public static void Scripts_do_what_menus_do()
        {
            var item = Scene.Holding(Shapes.Cube(), "Item");
            var original = Scene.MeshOf(item);
            var outcome = ChamferTools.Chamfer(new UnityEngine.Object[] { item }, ChamferSettings.Default);
            Check.That(outcome.IsDone && outcome.Failures.Count == 0, "done");
            Check.Equal("1 mesh: 12 edges full, 0 narrowed, 0 skipped", outcome.ToString());
            var modifier = item.GetComponent<ChamferModifier>();
            var settings = modifier.Settings;
            settings.width = 5;
            modifier.Settings = settings;
            modifier.IncludeChildren = modifier.ShowEdges = true;
            modifier.LivePreview = false;
            Check.That(modifier.includeChildren && modifier.showEdges && !modifier.livePreview, "set");
            Check.Equal(0, ChamferTools.Apply(modifier).Count);
            Check.Near(0.9f, Scene.MeshOf(item).vertices.Max(p => Math.Min(Math.Abs(p.x), Math.Abs(p.y))));
            original.vertices = original.vertices.Select(p => p * 2).ToArray();
            Check.That(ChamferTools.IsOutOfDate(modifier), "out of date");
            Check.That(ChamferTools.ChamferScenesAgain().IsDone && !ChamferTools.IsOutOfDate(modifier), "again");
            ChamferTools.Revert(new UnityEngine.Object[] { item });
            Check.That(Scene.MeshOf(item) == original, "reverted");
            Check.Equal(VerifyMode.Seen, ChamferTools.ProjectSettings.verify);
        }

        public static void Scripts_are_told_what_fails()
        {
            var bad = Shapes.Cube();
            bad.normals = new Vector3[0];
            Check.That(ChamferTools.Chamfer(new UnityEngine.Object[] { Scene.Holding(bad, "Bad") }, ChamferSettings.Default).Failures.Single().Contains("normals"), "failures");
            EditorUtility.onProgress = share => true;
            try { Check.That(!ChamferTools.Chamfer(new UnityEngine.Object[] { Scene.Holding(Shapes.Cube(), "Item") }, ChamferSettings.Default).IsDone, "cancelled"); }
            finally { EditorUtility.onProgress = share => false; }
            Check.Throws<ArgumentException>(() => ChamferTools.ChamferModelCopy(new GameObject("No model"), ChamferSettings.Default));
            var model = Scene.Holding(Shapes.Cube(), "Model");
            Scene.MakeAsset(model, "Assets/Api/model.glb");
            Check.That(ChamferTools.ChamferModelCopy(model, ChamferSettings.Default).IsDone, "a copy");
        }

        public static void Components_have_an_entry()
        {
            var item = Scene.Holding(Shapes.Cube(), "Item");
            var command = new MenuCommand { context = item.GetComponent<MeshFilter>() };
            Check.That(ComponentMenu.CanRun(command), "a mesh");
            Undo.Click();
            ComponentMenu.Run(command);
            Check.Equal(44 * 3, Scene.MeshOf(item).GetTriangles(0).Length);
            Check.Equal(VerifyMode.Seen, item.GetComponent<ChamferModifier>().settings.verify);
            Undo.PerformUndo();
            Check.Equal(0, item.GetComponents<ChamferModifier>().Length);
            item.GetComponent<MeshFilter>().sharedMesh = null;
            Check.That(!ComponentMenu.CanRun(command), "no mesh");
            var items = typeof(ComponentMenu).GetMethods(BindingFlags.Static | BindingFlags.NonPublic).SelectMany(method => method.GetCustomAttributes(typeof(MenuItem), false).Cast<MenuItem>());
            Check.Equal(4, items.Count(entry => entry.path.StartsWith("CONTEXT/") && entry.path.EndsWith("/Chamfer")));
        }

        public static void Folders_can_be_selected_and_dropped()
        {
            var folder = new Material();
            AssetDatabase.paths[folder] = "Assets/Dropped";
            var prefab = Scene.Holding(Shapes.Cube(), "Prefab");
            Scene.MakeAsset(prefab, "Assets/Dropped/Prefab.prefab");
            Selection.objects = new UnityEngine.Object[] { folder };
            Check.That(ChamferMenu.CanRun(), "a folder");
            ChamferMenu.Run();
            Check.Equal(44 * 3, Scene.MeshOf(prefab).GetTriangles(0).Length);
            var project = ScriptableObject.CreateInstance<ChamferProjectSettings>();
            Undo.Click();
            Check.That(FolderDrop.Add(project, new[] { "Assets/Dropped", "Assets/a.fbx" }), "added");
            Check.That(!FolderDrop.Add(project, new[] { "Assets/Dropped" }), "once");
            Check.Equal("Assets/Dropped", project.rules.Single().folder);
            Undo.PerformUndo();
            Check.Equal(0, project.rules.Count);
            DragAndDrop.paths = new[] { "Assets/Dropped" };
            GUILayout.broken = false;
            foreach (var type in new[] { EventType.Repaint, EventType.DragUpdated })
            {
                Event.current = new Event { type = type };
                Check.That(!FolderDrop.Draw(project), "" + type);
            }
            Check.Equal(DragAndDropVisualMode.Link, DragAndDrop.visualMode);
            Event.current = new Event { type = EventType.DragPerform };
            Check.That(FolderDrop.Draw(project) && project.rules.Count == 1, "dropped");
            DragAndDrop.paths = new string[0];
        }

        public static void Awaitables_end_as_the_work_does()
        {
            Check.Equal(44 * 3, MeshChamfer.RunAwaitable(Shapes.Cube(), ChamferSettings.Default).GetAwaiter().GetResult().Mesh.GetTriangles(0).Length);
            var settings = ChamferSettings.Default;
            settings.width = -1;
            Check.Throws<InvalidSettingsException>(() => MeshChamfer.RunAwaitable(Shapes.Cube(), settings).GetAwaiter().GetResult());
            var cancelled = new CancellationToken(true);
            Check.Throws<OperationCanceledException>(() => MeshChamfer.RunAwaitable(Shapes.Cube(), ChamferSettings.Default, null, cancelled).GetAwaiter().GetResult());
        }

        /// Against the stand-ins here; a real editor runs them as they are.
        public static void The_packages_own_tests_pass()
        {
            GameObject.Primitive = type => Shapes.Cube();
            var tests = Activator.CreateInstance(typeof(PackageTests.CubeTests));
            int count = 0;
            foreach (var test in typeof(PackageTests.CubeTests).GetMethods().Where(method => method.IsDefined(typeof(NUnit.Framework.TestAttribute), false)))
            {
                typeof(PackageTests.CubeTests).GetMethod("MakeCube").Invoke(tests, null);
                test.Invoke(tests, null);
                typeof(PackageTests.CubeTests).GetMethod("Clean").Invoke(tests, null);
                count++;
            }
            Check.Equal(5, count);
        }
    }
}

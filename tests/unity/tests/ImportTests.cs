using System;
using System.Collections.Generic;
using System.Linq;
using System.Reflection;
using Chamfer;
using Chamfer.Streams;
using ChamferEditor;
using UnityEditor;
using UnityEditor.AssetImporters;
using UnityEngine;

namespace Chamfer.Tests
{
    internal static class ImportTests
    {
        private static ModelRule Rule(string folder, float width = 1)
        {
            var settings = ChamferSettings.Default;
            settings.width = width;
            return new ModelRule { folder = folder, settings = settings };
        }

        private static bool Find(ModelFacts model, out ChamferSettings settings, params ModelRule[] rules)
        {
            return ImportRule.TryFind(model, ChamferSettings.Default, rules, out settings);
        }

        private static bool Find(string path, string label, out ChamferSettings settings)
        {
            var labels = label == null ? new string[0] : new[] { "Other", label };
            return Find(ModelFacts.At(path, labels), out settings, Rule("Assets/Props/Fine", 0.25f), Rule("Assets/Props/"));
        }

        /// As the file has them.
        private static void With(System.Action<ChamferProjectSettings> change, System.Action action)
        {
            var project = ChamferProjectSettings.instance;
            change(project);
            project.Write();
            ImportDependency.Register();
            try { action(); }
            finally
            {
                project.settings = ChamferProjectSettings.Usual();
                project.rules.Clear();
                project.Write();
                ImportDependency.Register();
            }
        }

        public static void Labels_and_folders_switch_chamfering_on()
        {
            ChamferSettings settings;
            Check.That(!Find("Assets/a.fbx", null, out settings), "off by default");
            Check.That(!Find("Assets/PropsElse/a.fbx", null, out settings), "another folder");
            Check.That(!Find("Assets/a.fbx", "ChamferNot", out settings), "another label");
            Check.That(Find("Assets/a.fbx", "Chamfer", out settings) && settings.width == 0.5f, "label");
            Check.That(Find("Assets/a.fbx", "chamfer=0.02", out settings), "width");
            Check.That(settings.width == 0.02f && settings.unit == WidthUnit.MeshUnits, "mesh units");
            Check.That(Find("Assets/a.fbx", "Chamfer=2%", out settings), "percent");
            Check.That(settings.width == 2 && settings.unit == WidthUnit.PercentOfExtent, "percent");
            Check.That(Find("Assets/Props/a.fbx", null, out settings) && settings.width == 1, "folder");
            Check.That(Find("Assets/Props/Fine/a.fbx", null, out settings) && settings.width == 0.25f, "nearer folder");
        }

        /// By the names that its renderers give them.
        public static void Models_know_their_materials()
        {
            var cube = Shapes.Cube();
            var wood = new[] { new MaterialFactor { material = "Wood", factor = 3 } };
            With(project => project.settings.edges.materials = wood, () => Import(cube, "Chamfer=0.1"));
            Check.Near(0.3f, 1 - cube.vertices.Max(p => System.Math.Min(System.Math.Abs(p.x), System.Math.Abs(p.y))));
        }

        public static void A_folder_without_a_width_takes_the_common_settings()
        {
            ChamferSettings settings;
            Check.That(Find(ModelFacts.At("Assets/New/a.fbx", new string[0]), out settings, Rule("Assets/New", 0)), "on");
            Check.Equal(ChamferSettings.Default, settings);
        }

        private static AssetImportContext Import(Mesh mesh, params string[] labels)
        {
            return Import(Scene.Holding(mesh, "Model"), labels);
        }

        private static AssetImportContext Import(GameObject root, params string[] labels)
        {
            AssetDatabase.labels["Assets/model.fbx"] = labels;
            var context = new AssetImportContext();
            var importer = new ModelChamfer { assetPath = "Assets/model.fbx", context = context };
            var hook = typeof(ModelChamfer).GetMethod("OnPostprocessModel", BindingFlags.Instance | BindingFlags.NonPublic);
            hook.Invoke(importer, new object[] { root });
            return context;
        }

        public static void Importing_replaces_what_the_mesh_holds()
        {
            var mesh = Shapes.FullCube();
            Check.Equal(0, Import(mesh, "Chamfer=0.1").warnings.Count);
            Check.Equal(44 * 3, mesh.GetTriangles(0).Length);
            Check.Equal(2, mesh.blendShapeCount);
            Check.Equal(2, mesh.bindposes.Length);
        }

        public static void A_label_may_name_segments()
        {
            var mesh = Shapes.FullCube();
            Check.Equal(0, Import(mesh, "Chamfer=0.1,3").warnings.Count);
            // Of each face two triangles, of each edge two for each segment, of each corner their square.
            Check.Equal((12 + 12 * 2 * 3 + 8 * 9) * 3, mesh.GetTriangles(0).Length);
            mesh = Shapes.FullCube();
            Check.Equal(0, Import(mesh, "Chamfer=2%,3").warnings.Count);
            Check.Equal((12 + 12 * 2 * 3 + 8 * 9) * 3, mesh.GetTriangles(0).Length);
            foreach (string label in new[] { "Chamfer=0.1,0", "Chamfer=0.1,33", "Chamfer=0.1,x", "Chamfer=0.1,2,2" })
            {
                Check.That(Import(Shapes.Cube(), label).warnings.Single().Contains("Chamfer=2%,3"), label);
            }
        }

        public static void A_submesh_of_their_own_is_imported_with_a_material()
        {
            var mesh = Shapes.Cube();
            GameObject first = Scene.Holding(mesh, "First"), second = Scene.Holding(mesh, "Second");
            first.children.Add(second);
            With(project => project.settings.submeshMode = ChamferSubmesh.Own, () => Import(first, "Chamfer"));
            Check.Equal(2, mesh.subMeshCount);
            foreach (var renderer in first.GetComponentsInChildren<Renderer>(true)) { Check.Equal(2, renderer.sharedMaterials.Length); }
        }

        public static void Importing_without_a_label_changes_nothing()
        {
            var mesh = Shapes.Cube();
            Import(mesh);
            Check.Equal(36, mesh.GetTriangles(0).Length);
        }

        public static void Failures_are_warnings()
        {
            var mesh = Shapes.Cube();
            mesh.normals = new Vector3[0];
            Check.That(Import(mesh, "Chamfer").warnings.Single().Contains("normals"), "no normals");
            Check.That(Import(Shapes.Cube(), "Chamfer=wide").warnings.Single().Contains("Chamfer=0.02"), "bad label");
        }

        /// Each names what could concern it, before anybody knows whether it does.
        public static void Every_model_depends_on_what_could_concern_it()
        {
            var expected = new[] { ImportDependency.Rules, "com.chamfer.unity/Label/Assets/model.fbx", "com.chamfer.unity/Folder/Assets" };
            Check.That(Import(Shapes.Cube()).dependencies.SequenceEqual(expected), "left alone");
            Check.That(Import(Shapes.Cube(), "Chamfer=wide").dependencies.SequenceEqual(expected), "a bad label");
            Check.That(Import(Shapes.Cube(), "Chamfer").dependencies.SequenceEqual(expected.Concat(new[] { ImportDependency.Settings })), "chamfered");
            Check.That(ImportDependency.Of("Assets/A/B/c.fbx").Skip(2).SequenceEqual(new[]
            {
                "com.chamfer.unity/Folder/Assets/A/B", "com.chamfer.unity/Folder/Assets/A", "com.chamfer.unity/Folder/Assets"
            }), "each folder");
        }

        private static Hash128 HashOf(string name)
        {
            Hash128 hash;
            return AssetDatabase.dependencies.TryGetValue("com.chamfer.unity/" + name, out hash) ? hash : new Hash128();
        }

        public static void What_models_depend_on_tells_the_settings()
        {
            ImportDependency.Register();
            Check.Equal(3, LibraryCheck.Version().Split('.').Length);
            Check.That(HashOf("ProjectSettings").text.StartsWith(LibraryCheck.Version() + "\n"), "the library's version");
            Hash128 settings = HashOf("ProjectSettings"), rules = HashOf("Rules"), folder = HashOf("Folder/Assets/Rule");
            ImportDependency.Register();
            Check.Equal(settings, HashOf("ProjectSettings"));
            With(project => project.settings.width = 3, () => Check.That(!settings.Equals(HashOf("ProjectSettings")), "settings"));
            With(project => project.rules.Add(Rule("Assets/Rule/")), () =>
            {
                Check.That(!folder.Equals(HashOf("Folder/Assets/Rule")), "folder");
                Check.Equal(rules, HashOf("Rules"));
            });
            Check.Equal(folder, HashOf("Folder/Assets/Rule"));
            With(project => project.rules.Add(new ModelRule { pattern = "*_low" }), () => Check.That(!rules.Equals(HashOf("Rules")), "rules"));
        }

        /// Unity keeps what it was told, also while the editor is closed.
        public static void Labels_that_went_while_nobody_looked_are_forgotten()
        {
            WithModel("Assets/Reach/d.fbx", isChamfered =>
            {
                AssetDatabase.labels["Assets/Reach/d.fbx"] = new[] { "Chamfer" };
                ImportDependency.Register();
                AssetDatabase.Refresh();
                Check.That(isChamfered(), "chamfered");
                AssetDatabase.labels.Remove("Assets/Reach/d.fbx");
                var known = typeof(ImportDependency).GetField("labels", BindingFlags.Static | BindingFlags.NonPublic).GetValue(null);
                ((System.Collections.IDictionary)known).Clear();
                ImportDependency.Register();
                AssetDatabase.Refresh();
                Check.That(!isChamfered(), "and back");
            });
        }

        private static void WithModel(string path, System.Action<System.Func<bool>> action)
        {
            Project.postprocessors.Clear();
            Project.postprocessors.AddRange(new[] { typeof(ModelChamfer), typeof(ImportChanges) });
            Project.AddModel(path, () => Scene.Holding(Shapes.Cube(), "Model"));
            EditorApplication.Idle();
            AssetDatabase.imported.Clear();
            try { action(() => Scene.MeshOf((GameObject)Project.Loaded(path)).GetTriangles(0).Length == 44 * 3); }
            finally { Project.postprocessors.Clear(); }
        }

        public static void A_new_rule_reaches_models_that_were_left_alone()
        {
            WithModel("Assets/Reach/a.fbx", isChamfered => With(project => project.rules.Add(Rule("Assets/Reach")), () =>
            {
                Check.That(!isChamfered(), "not yet");
                AssetDatabase.Refresh();
                Check.That(isChamfered(), "chamfered");
            }));
        }

        public static void Another_rule_imports_nobody_else_again()
        {
            WithModel("Assets/Reach/b.fbx", isChamfered => With(project => project.rules.Add(Rule("Assets/Other")), () =>
            {
                AssetDatabase.Refresh();
                Check.That(!AssetDatabase.imported.Contains("Assets/Reach/b.fbx"), "left alone");
            }));
        }

        public static void A_label_that_changes_imports_the_model_again()
        {
            WithModel("Assets/Reach/c.fbx", isChamfered =>
            {
                AssetDatabase.labels["Assets/Reach/c.fbx"] = new[] { "Chamfer" };
                ImportChanges.Listen();
                EditorApplication.projectChanged();
                EditorApplication.Idle();
                Check.That(isChamfered(), "chamfered");
                AssetDatabase.labels["Assets/Reach/c.fbx"] = new string[0];
                EditorApplication.projectChanged();
                EditorApplication.Idle();
                Check.That(!isChamfered(), "and back");
                Check.Equal(2, AssetDatabase.imported.Count);
                EditorApplication.projectChanged();
                EditorApplication.Idle();
                Check.Equal(2, AssetDatabase.imported.Count);
            });
        }

        public static void A_model_that_moves_is_imported_where_another_rule_holds()
        {
            With(project => project.rules.Add(Rule("Assets/There")), () => WithModel("Assets/Here/a.fbx", isChamfered =>
            {
                Project.Move("Assets/Here/a.fbx", "Assets/Near/a.fbx");
                EditorApplication.Idle();
                Check.Equal(0, AssetDatabase.imported.Count);
                Project.Move("Assets/Near/a.fbx", "Assets/There/a.fbx");
                EditorApplication.Idle();
                Check.Equal("together: Assets/There/a.fbx", AssetDatabase.imported.Single());
            }));
        }

        /// A process that helps with importing keeps what it knew when it started.
        public static void Settings_are_read_from_the_file()
        {
            WithModel("Assets/File/a.fbx", isChamfered => With(project => project.rules.Add(Rule("Assets/File")), () =>
            {
                ChamferProjectSettings.instance.rules.Clear();
                AssetDatabase.ImportAsset("Assets/File/a.fbx", ImportAssetOptions.Default);
                Check.That(isChamfered(), "as the file says");
            }));
        }

        public static void Importing_again_imports_each_once()
        {
            WithModel("Assets/Once/a.fbx", isChamfered => With(project => { project.rules.Add(Rule("Assets/Once")); project.rules.Add(Rule("Assets")); }, () =>
            {
                ModelImports.All();
                Check.Equal(1, AssetDatabase.imported.Count(path => path == "together: Assets/Once/a.fbx"));
                Check.That(isChamfered() && AssetDatabase.editing == 0, "chamfered");
                AssetDatabase.imported.Clear();
                AssetDatabase.Refresh();
                Check.That(!AssetDatabase.imported.Any(path => path.EndsWith("Once/a.fbx")), "not once more");
                ChamferProjectSettings.instance.rules.Clear();
                ChamferProjectSettings.instance.Write();
                ModelImports.All();
                Check.That(!isChamfered(), "what no rule concerns any more, too");
            }));
        }

        public static void Rules_look_at_name_label_triangles_and_size()
        {
            var model = ModelFacts.At("Assets/Props/Crate_Low.fbx", new[] { "Prop" }).With(new[] { Shapes.Cube(), null, Shapes.Cube() }.Where(mesh => mesh != null));
            Check.Equal(24, model.Triangles);
            Check.Equal(2f, model.Size);
            System.Func<ModelRule, bool> finds = rule => { ChamferSettings settings; return Find(model, out settings, rule); };
            Check.That(finds(new ModelRule { pattern = "*_low" }) && !finds(new ModelRule { pattern = "low" }), "name");
            Check.That(finds(new ModelRule { pattern = "crate?low" }) && !finds(new ModelRule { pattern = "*.fbx" }), "one letter");
            Check.That(finds(new ModelRule { label = "prop" }) && !finds(new ModelRule { label = "Hero" }), "label");
            Check.That(finds(new ModelRule { label = "Prop", fewestTriangles = 24 }) && !finds(new ModelRule { label = "Prop", fewestTriangles = 25 }), "few");
            Check.That(finds(new ModelRule { label = "Prop", mostTriangles = 24 }) && !finds(new ModelRule { label = "Prop", mostTriangles = 23 }), "many");
            Check.That(finds(new ModelRule { label = "Prop", smallestSize = 2 }) && !finds(new ModelRule { label = "Prop", smallestSize = 2.1f }), "small");
            Check.That(finds(new ModelRule { label = "Prop", largestSize = 2 }) && !finds(new ModelRule { label = "Prop", largestSize = 1.9f }), "large");
            Check.That(!finds(new ModelRule()), "a rule that says nothing");
        }

        public static void Models_can_be_left_out()
        {
            ChamferSettings settings;
            var excluded = Rule("Assets/Props/Old");
            excluded.exclude = true;
            var model = ModelFacts.At("Assets/Props/Old/a.fbx", new string[0]);
            Check.That(!Find(model, out settings, Rule("Assets/Props"), excluded), "the nearer one");
            Check.That(Find(ModelFacts.At("Assets/Props/Old/a.fbx", new[] { "Chamfer" }), out settings, excluded), "a label goes before");
            Check.That(Find(model, out settings, Rule("Assets/Props/Old", 3), excluded) && settings.width == 3, "of two for a folder the upper one");
        }

        public static void Rules_can_be_tried()
        {
            Check.Equal("No model would change.", DryRun.Summary(new List<DryRunRow>()));
            WithModel("Assets/Try/a.fbx", first => WithModel("Assets/Try/b.fbx", second =>
            {
                System.Func<List<DryRunRow>> run = () => DryRun.Run(ChamferProjectSettings.instance).Where(row => row.Path.StartsWith("Assets/Try/")).ToList();
                Check.Equal(0, run().Count);
                With(project => project.rules.Add(new ModelRule { folder = "Assets/Try", mostTriangles = 12, settings = ChamferSettings.Default }), () =>
                {
                    var rows = run();
                    Check.Equal("2 models would be chamfered.", DryRun.Summary(rows));
                    Check.Equal("Assets/Try/a.fbx", rows[0].Path);
                    Check.That(rows[0].Text.StartsWith("0.5 percent, Full; 12 -> 44 triangles; 1 mesh: 12 edges full"), rows[0].Text);
                    Check.That(!first() && !second(), "nothing was imported");
                    AssetDatabase.ImportAsset("Assets/Try/a.fbx", ImportAssetOptions.Default);
                    Check.Equal("Assets/Try/b.fbx", run().Single().Path);
                });
                Check.Equal("1 model would be left alone again.", DryRun.Summary(run()));
                AssetDatabase.labels["Assets/Try/a.fbx"] = new[] { "Chamfer=3%" };
                Check.Equal("now: 0.5 percent, Full; then: 3 percent, Seen", run().Single().Text);
                AssetDatabase.labels["Assets/Try/a.fbx"] = new[] { "Chamfer=x" };
                Check.Equal(ImportOutcome.Failed, run().Single().Outcome);
                AssetDatabase.labels.Remove("Assets/Try/a.fbx");
                var create = typeof(ChamferSettingsPage).GetMethod("Create", BindingFlags.Static | BindingFlags.NonPublic);
                GUILayout.broken = false;
                GUILayout.clicked = "Try Rules";
                Check.Throws<ExitGUIException>(() => ((SettingsProvider)create.Invoke(null, null)).guiHandler(""));
                EditorGUILayout.boxes.Clear();
                GUILayout.depth = 0;
                typeof(DryRunWindow).GetMethod("OnGUI", BindingFlags.Instance | BindingFlags.NonPublic).Invoke(EditorWindow.opened, null);
                Check.That(EditorGUILayout.boxes.Contains("now: 0.5 percent, Full"), string.Join("/", EditorGUILayout.boxes.ToArray()));
                Check.Equal(0, GUILayout.depth);
            }));
        }

        public static void Models_record_what_was_done()
        {
            var record = (ChamferRecord)Import(Shapes.Cube(), "Chamfer=0.1").objects.Single();
            Check.Equal(0.1f, record.settings.width);
            Check.That(record.report.StartsWith("Cube: 12 hard edges: 12 full"), record.report);
            var bad = Shapes.Cube();
            bad.normals = new Vector3[0];
            Check.That(((ChamferRecord)Import(bad, "Chamfer").objects.Single()).failures.Single().Contains("normals"), "failures");
            Check.Equal(0, Import(Shapes.Cube()).objects.Count);
        }

        public static void Unreadable_models_are_chamfered_and_stay_so()
        {
            var mesh = Shapes.FullCube();
            mesh.readable = false;
            Check.Equal(0, Import(mesh, "Chamfer").warnings.Count);
            Check.Equal(132, MeshReader.Read(mesh).Submeshes[0].Indices.Length);
            Check.That(!mesh.isReadable, "as before");
        }

        public static void Quads_are_named()
        {
            var mesh = Shapes.Cube();
            mesh.subMeshCount = 2;
            mesh.SetIndices(new[] { 0, 1, 3, 2 }, MeshTopology.Quads, 1, false);
            Check.That(Import(mesh, "Chamfer").warnings.Single().Contains("Keep Quads"), "in the console");
            Check.Equal(4, mesh.GetIndices(1).Length);
            var item = Scene.Holding(Shapes.Cube(), "Item");
            Scene.MeshOf(item).SetIndices(new[] { 0, 1, 3, 2 }, MeshTopology.Quads, 0, false);
            Check.That(new ChamferSelection(new[] { item }).Chamfer(ChamferSettings.Default).ToString().Contains("Keep Quads"), "in the menu");
        }

        public static void Levels_of_detail_are_made_anew()
        {
            foreach (bool isReadable in new[] { true, false })
            {
                var mesh = Shapes.Cube();
                mesh.lodCount = 3;
                mesh.readable = isReadable;
                Import(mesh, "Chamfer");
                Check.Equal(3, mesh.lodCount);
                Check.Equal(mesh.version, mesh.lodsOf);
                var result = MeshChamfer.Run(mesh, ChamferSettings.Default).Mesh;
                Check.Equal(3, result.lodCount);
                Check.Equal(result.version, result.lodsOf);
            }
            Check.Equal(1, MeshChamfer.Run(Shapes.Cube(), ChamferSettings.Default).Mesh.lodCount);
        }

        public static void A_label_that_does_nothing_is_told()
        {
            WithModel("Assets/Deaf/a.fbx", isChamfered =>
            {
                AssetDatabase.labels["Assets/Deaf/b.glb"] = new[] { "Chamfer" };
                int logged = Debug.logged.Count;
                Project.AddModel("Assets/Deaf/b.glb", () => Scene.Holding(Shapes.Cube(), "Model"), new ScriptedImporter());
                Check.Equal(1, Debug.logged.Count - logged);
                AssetDatabase.ImportAsset("Assets/Deaf/b.glb", ImportAssetOptions.Default);
                Check.Equal(1, Debug.logged.Count - logged);
                Check.That(Debug.logged.Last().Contains("b.glb") && Debug.logged.Last().Contains("Chamfer Model Asset"), Debug.logged.Last());
            });
        }

        public static void Any_model_has_a_chamfered_copy_that_follows_it()
        {
            var model = Scene.Holding(Shapes.Cube(), "Model");
            Scene.MakeAsset(model, "Assets/Copy/model.glb");
            Selection.objects = new UnityEngine.Object[] { model };
            Check.That(ModelCopyMenu.CanRun(), "a model");
            for (int time = 0; time < 2; time++)
            {
                Undo.Click();
                ModelCopyMenu.Run();
                var copy = AssetDatabase.LoadAssetAtPath<GameObject>("Assets/Copy/model Chamfered.prefab");
                Check.Equal(44 * 3, Scene.MeshOf(copy).GetTriangles(0).Length);
                Check.Equal("Assets/Copy/model Chamfered.prefab", AssetDatabase.GetAssetPath(Scene.MeshOf(copy)));
                Check.Equal(12 * 3, Scene.MeshOf(model).GetTriangles(0).Length);
                Check.That(PrefabUtility.GetCorrespondingObjectFromSource(copy) == model, "a variant");
                Check.Equal(2, Scene.FilesIn("Assets/Copy/").Count);
            }
            Check.That(Debug.logged.Last().Contains("1 mesh chamfered already"), Debug.logged.Last());
            Selection.objects = new UnityEngine.Object[] { AssetDatabase.LoadAssetAtPath<GameObject>("Assets/Copy/model Chamfered.prefab"), Scene.MeshOf(model) };
            Check.That(!ModelCopyMenu.CanRun(), "no model");
        }

        public static void Labels_are_written_as_they_are_read()
        {
            var settings = ChamferSettings.Default;
            settings.width = 0.1f;
            Check.Equal("Chamfer=0.1%", ImportRule.LabelOf(settings));
            settings.unit = WidthUnit.MeshUnits;
            ChamferSettings read;
            Check.That(Find("Assets/a.fbx", ImportRule.LabelOf(settings), out read), "label");
            Check.That(read.width == settings.width && read.unit == settings.unit, "the same width");
        }
    }
}

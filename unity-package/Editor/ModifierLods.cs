using System.Collections.Generic;
using System.Linq;
using Chamfer;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>
    /// Shows the source again where the object is far away: a chamfer that is narrower than a pixel glitters, and its
    /// triangles are for nothing.
    /// </summary>
    internal static class ModifierLods
    {
        private const string Action = "Chamfer LOD";

        /// <summary>Below this share of the picture's height, an object of a new group is not drawn.</summary>
        private const float Culled = 0.01f;

        /// <summary>Makes a group, or a new level in the one that there is; returns why not, or null.</summary>
        internal static string Make(ChamferModifier modifier)
        {
            if (EditorUtility.IsPersistent(modifier)) { return "Open the prefab to give it levels of detail"; }
            Drop(modifier);
            var near = RenderersOf(modifier);
            if (near.Count == 0) { return "Chamfer the object first"; }
            Undo.RecordObject(modifier, Action);
            var far = modifier.meshes.Where(IsThere).Select(entry => MakeFar(modifier, entry)).ToArray();
            var group = GroupOf(modifier, near);
            if (group == null) { MakeGroup(modifier, near, far); }
            else { Extend(group, near, far, LodHeight.Of(modifier)); }
            SlotEditing.Changed(modifier);
            return null;
        }

        /// <summary>Takes away what <see cref="Make"/> made.</summary>
        internal static void Drop(ChamferModifier modifier)
        {
            var objects = modifier.farObjects.Where(item => item != null).ToList();
            if (objects.Count == 0) { return; }
            var far = objects.Select(item => item.GetComponent<Renderer>()).ToList();
            var group = GroupOf(modifier, far);
            Undo.RecordObject(modifier, Action);
            if (group != null && modifier.madeGroup) { Undo.DestroyObjectImmediate(group); }
            else if (group != null) { Remove(group, far); }
            foreach (var item in objects) { Undo.DestroyObjectImmediate(item); }
            modifier.farObjects.Clear();
            modifier.madeGroup = false;
            SlotEditing.Changed(modifier);
        }

        /// <summary>Whether an object only shows a source far away, and is not to be chamfered.</summary>
        internal static bool IsFar(Component holder)
        {
            var modifiers = holder.GetComponentsInParent<ChamferModifier>(true);
            return modifiers.Any(modifier => modifier.farObjects.Contains(holder.gameObject));
        }

        private static bool IsThere(ChamferedMesh entry)
        {
            return entry.holder != null && entry.original != null && entry.holder.GetComponent<Renderer>() != null;
        }

        private static List<Renderer> RenderersOf(ChamferModifier modifier)
        {
            return modifier.meshes.Where(IsThere).Select(entry => entry.holder.GetComponent<Renderer>()).ToList();
        }

        /// <summary>The group that shows some of the renderers; null if none does.</summary>
        private static LODGroup GroupOf(ChamferModifier modifier, List<Renderer> renderers)
        {
            var groups = modifier.GetComponentsInParent<LODGroup>(true);
            return groups.FirstOrDefault(group => group.GetLODs().Any(level => level.renderers.Any(renderers.Contains)));
        }

        private static Renderer MakeFar(ChamferModifier modifier, ChamferedMesh entry)
        {
            var item = new GameObject(entry.holder.name + " Source");
            Undo.RegisterCreatedObjectUndo(item, Action);
            item.transform.SetParent(entry.holder.transform, false);
            item.layer = entry.holder.gameObject.layer;
            var renderer = FarRenderer.Make(item, entry);
            modifier.farObjects.Add(item);
            return renderer;
        }

        private static void MakeGroup(ChamferModifier modifier, List<Renderer> near, Renderer[] far)
        {
            var group = Undo.AddComponent<LODGroup>(modifier.gameObject);
            group.SetLODs(new[] { new LOD(LodHeight.Of(modifier), near.ToArray()), new LOD(Culled, far) });
            group.RecalculateBounds();
            modifier.madeGroup = true;
        }

        /// <summary>The level of the chamfered mesh is shared out; where the group ends stays.</summary>
        private static void Extend(LODGroup group, List<Renderer> near, Renderer[] far, float height)
        {
            Undo.RecordObject(group, Action);
            var levels = group.GetLODs().ToList();
            int level = levels.FindIndex(one => one.renderers.Any(near.Contains));
            float above = level > 0 ? levels[level - 1].screenRelativeTransitionHeight : 1;
            var shared = levels[level];
            levels.Insert(level + 1, new LOD(shared.screenRelativeTransitionHeight, far));
            shared.screenRelativeTransitionHeight = LodHeight.Between(height, shared.screenRelativeTransitionHeight, above);
            levels[level] = shared;
            group.SetLODs(levels.ToArray());
        }

        private static void Remove(LODGroup group, List<Renderer> far)
        {
            Undo.RecordObject(group, Action);
            var levels = group.GetLODs().ToList();
            int level = levels.FindIndex(one => one.renderers.Any(far.Contains));
            if (level > 0)
            {
                var before = levels[level - 1];
                before.screenRelativeTransitionHeight = levels[level].screenRelativeTransitionHeight;
                levels[level - 1] = before;
            }
            levels.RemoveAt(level);
            group.SetLODs(levels.ToArray());
        }
    }
}

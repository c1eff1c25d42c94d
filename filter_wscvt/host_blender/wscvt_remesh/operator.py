# SPDX-License-Identifier: GPL-3.0-or-later
"""Object > Remesh Grain (WSCVT): remeshes the selected objects in turn, with progress and Esc."""
import sys

import bpy

from . import carry, grain

try:
    from . import wscvt
    MISSING = ""
except ImportError as error:
    wscvt = None
    MISSING = (f"The wscvt module of this add-on does not load in Python {sys.version.split()[0]}: "
               f"{error}. Make the add-on for this Python, see filter_wscvt/host_blender/README.md.")


class OBJECT_OT_remesh_grain_wscvt(bpy.types.Operator):
    """Remesh the selected scans of grains to exactly the number of nodes of the Grain panel"""
    bl_idname = "object.remesh_grain_wscvt"
    bl_label = "Remesh Grain (WSCVT)"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return context.mode == "OBJECT" and any(one.type == "MESH" for one in context.selected_objects)

    def execute(self, context):
        if not self.begin(context):
            return {"CANCELLED"}
        while self.next_job(context):
            self.job.wait()
            self.take_result(context)
        return self.end(context)

    def invoke(self, context, event):
        if not self.begin(context):
            return {"CANCELLED"}
        manager = context.window_manager
        self.timer = manager.event_timer_add(0.1, window=context.window)
        manager.modal_handler_add(self)
        manager.progress_begin(0, 100)
        self.next_job(context)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC":
            self.is_cancelled = True
            if self.job:
                self.job.cancel()
        # Other events are blocked, because they could change the scan during the work.
        if event.type != "TIMER":
            return {"RUNNING_MODAL"}
        self.show_progress(context)
        if self.job and not self.job.is_done():
            return {"RUNNING_MODAL"}
        if self.job:
            self.take_result(context)
        if not self.is_cancelled and self.next_job(context):
            return {"RUNNING_MODAL"}
        context.window_manager.event_timer_remove(self.timer)
        context.window_manager.progress_end()
        return self.end(context)

    def begin(self, context):
        if not wscvt:
            self.report({"ERROR"}, MISSING)
            return False
        self.arguments = context.scene.wscvt.options()
        self.scans = sorted((one for one in context.selected_objects if one.type == "MESH"),
                            key=lambda one: one.name)
        self.count = len(self.scans)
        self.made, self.failures = [], []
        self.job, self.is_cancelled = None, False
        return True

    def next_job(self, context):
        """Starts the next readable object. Returns False if there is none."""
        self.job = None
        while self.scans and not self.job:
            self.scanned = self.scans.pop(0)
            try:
                self.linear = grain.scale_and_rotation(self.scanned.matrix_world)
                self.scan = carry.Scan(context, self.scanned)
            except ValueError as error:
                self.failures.append(f"{self.scanned.name}: {error}")
                continue
            vertices, faces = grain.transformed(self.scan.vertices, self.scan.triangles, self.linear)
            self.job = grain.Job(wscvt.remesh, vertices, faces,
                                 {**self.arguments, "source": self.scanned.name})
        return self.job is not None

    def take_result(self, context):
        """Adds the result of the finished job as an object, or stores its error."""
        job, self.job = self.job, None
        if job.error is not None:
            self.is_cancelled |= getattr(job.error, "code", "") == "cancelled"
            if not self.is_cancelled:
                self.failures.append(f"{self.scanned.name}: {job.error}")
            return
        self.made.append(carry.add_result(context, self.scanned, self.scan, job.result, self.linear,
                                          self.arguments["distances"]))
        for warning in job.result.warnings:
            self.report({"WARNING"}, f"{self.scanned.name}: {warning}")

    def show_progress(self, context):
        done = self.count - len(self.scans) - (1 if self.job else 0)
        percent = 100.0 * (done + (self.job.fraction if self.job else 0.0)) / self.count
        manager = context.window_manager
        manager.progress_update(percent)
        manager.wscvt_progress = percent
        manager.wscvt_at_work = f"Grain {min(done + 1, self.count)} of {self.count}: {self.scanned.name}"
        context.workspace.status_text_set(f"{manager.wscvt_at_work}, {percent:.0f} %. Esc cancels.")
        for area in context.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()

    def end(self, context):
        context.window_manager.wscvt_at_work = ""
        if context.workspace:
            context.workspace.status_text_set(None)
        if self.made:
            bpy.ops.object.select_all(action="DESELECT")
            for one in self.made:
                one.select_set(True)
            context.view_layer.objects.active = self.made[-1]
        for failure in self.failures:
            # An error report would end the calling script, although there are results.
            self.report({"WARNING" if self.made else "ERROR"}, failure)
        if self.is_cancelled:
            self.report({"WARNING"}, f"Cancelled: {len(self.made)} of {self.count} grains were remeshed.")
        elif self.made:
            self.report({"INFO"}, f"{len(self.made)} of {self.count} grains were remeshed.")
        return {"FINISHED"} if self.made else {"CANCELLED"}
